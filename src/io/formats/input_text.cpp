// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/input_text.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

namespace fs = std::filesystem;

/// Number of bytes of the UTF-8 character at the start of a text; 0 when there is none (The Unicode
/// Standard, table 3-7).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const auto follows = [&](std::size_t i, unsigned lower, unsigned upper) {
    return byte(i) >= lower && byte(i) <= upper;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1, 0x80, 0xBF) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF)
    return follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF) &&
                   follows(2, 0x80, 0xBF)
               ? 3
               : 0;
  if (first >= 0xF0 && first <= 0xF4)
    return follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF) &&
                   follows(2, 0x80, 0xBF) && follows(3, 0x80, 0xBF)
               ? 4
               : 0;
  return 0;
}

bool is_control(char c) {
  const auto code = static_cast<unsigned char>(c);
  return (code < 0x20 && c != '\t' && c != '\n' && c != '\r') || code == 0x7F;
}

void check_text(const std::string& path, const std::string& text, const std::string& kind) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_length(std::string_view(text).substr(at, 4));
    if (length == 0 || is_control(text[at]))
      throw InputError(
          fmt::format("{}, line {}", path,
                      1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n')),
          fmt::format("has the byte 0x{:02X}, which is {}", static_cast<unsigned char>(text[at]),
                      length == 0 ? "not UTF-8" : "no text"),
          kind + " of text in UTF-8", "save it as UTF-8, or check the path");
    at += length;
  }
}

void check_file(const std::string& path, const std::string& kind, std::uintmax_t largest) {
  std::error_code failed;
  const fs::file_type type = fs::status(path, failed).type();
  if (type == fs::file_type::not_found)
    throw InputError(path, "does not exist", kind, "check the path");
  if (type == fs::file_type::directory)
    throw InputError(path, "is a folder", kind, "name a file in it");
  if (type == fs::file_type::none || type == fs::file_type::unknown)
    throw InputError(path, fmt::format("cannot be opened ({})", failed.message()), kind,
                     "check the path and its permissions");
  if (type != fs::file_type::regular) throw InputError(path, "is no regular file", kind);
  const std::uintmax_t size = fs::file_size(path, failed);
  if (!failed && size > largest)
    throw InputError(path, fmt::format("has {} bytes", size),
                     fmt::format("{} of at most {} bytes", kind, largest), "check the path");
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(), is_control);
}

std::string read_input_bytes(const std::string& path, const std::string& kind,
                             std::uintmax_t largest) {
  check_file(path, kind, largest);
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError(path,
                     fmt::format("cannot be opened ({})", std::generic_category().message(errno)),
                     kind, "check its permissions");
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw InputError(path, "cannot be read to its end", kind, "check the disk");
  return bytes;
}

std::string read_input_text(const std::string& path, const std::string& kind,
                            std::uintmax_t largest) {
  return text_of_bytes(read_input_bytes(path, kind, largest), path, kind);
}

std::string text_of_bytes(std::string bytes, const std::string& path, const std::string& kind) {
  if (bytes.compare(0, 3, "\xEF\xBB\xBF") == 0) bytes.erase(0, 3);
  check_text(path, bytes, kind);
  return bytes;
}

}  // namespace furrow
