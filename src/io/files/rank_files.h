// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Numbers that each rank keeps in a sealed file by itself: "<stem>.<rank>". A rank without numbers
/// has no file. All ranks must share the folder.

#include <optional>
#include <string>

#include "furrow/core/rank_numbers.h"
#include "furrow/io/files/sealed_file.h"

namespace furrow {

class RankFiles : public RankNumbers {
 public:
  RankFiles(std::string stem, int rank);
  /// An unclosed file of this rank is removed.
  ~RankFiles() override;
  RankFiles(const RankFiles&) = delete;
  RankFiles& operator=(const RankFiles&) = delete;

  void append(const double* numbers, std::size_t count) override;
  void check(int rank) override;
  void read(int rank, std::uint64_t first, double* numbers, std::size_t count) override;
  /// Closes the file of this rank. @return what could not be written, and why; nothing: all is
  std::string close();

 private:
  std::string path(int rank) const;
  [[noreturn]] void refuse(int rank, const std::string& problem) const;
  void open_file(int rank);

  std::string stem_;
  int rank_;
  std::optional<SealedFile> written_;
  std::string failure_;
  int open_rank_ = -1, handle_ = -1;  // of the file that is read
};

}  // namespace furrow
