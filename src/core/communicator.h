// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// The only user of MPI in src/: sums over the ranks of a run.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace furrow {

/// The ranks that share a run. Default: this process alone.
class Communicator {
 public:
  Communicator();
  /// @param mpi_comm points to a live MPI_Comm; it is copied, not duplicated
  /// @param longest_message numbers in one message of MPI, which counts them with an int; longer
  /// arrays are sent in parts
  explicit Communicator(const void* mpi_comm, std::size_t longest_message = std::size_t(1) << 26);
  ~Communicator();
  Communicator(const Communicator&);
  Communicator& operator=(const Communicator&);

  int rank() const;
  int size() const;
  int on_this_machine() const;  ///< number of ranks that share the memory of this one; collective
  /// Sums the numbers of all ranks in place; every rank gets bitwise the same result, in rank order
  /// of the tree MPI uses.
  void sum(double* values, std::size_t count) const;
  double sum(double value) const;
  double max(double value) const;
  void max(double* values, std::size_t count) const;  ///< of each in place
  bool any(bool value) const;

  /// Numbers for another rank, and those received from it.
  struct Message {
    int other = 0;
    std::vector<double> sent = {};
    std::vector<double> received = {};
  };
  /// Exchanges all messages, at most one with each rank. Both sides call it, and `received` has the
  /// length that the other sends. Empty messages are not sent.
  void exchange(std::vector<Message>& messages) const;
  /// Sets the length of each `received` to that of the message.
  void exchange_lengths(std::vector<Message>& messages) const;

  /// The numbers of all ranks, in rank order, on every rank.
  std::vector<double> gather(const std::vector<double>& numbers) const;
  /// Gathers the numbers on the first rank; nothing on the others.
  std::vector<double> gather_to_first(const std::vector<double>& numbers) const;

 private:
  std::vector<std::uint64_t> lengths_on_ranks(std::size_t mine) const;
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace furrow
