// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Text of input files, which people write by hand.

#include <cstdint>
#include <string>
#include <string_view>

namespace furrow {

/// @param kind "a YAML file", for errors
/// @param largest [bytes]
/// @returns the text without a byte order mark
/// @throws InputError when the file does not exist, is a folder or a device, may not be read, is
/// larger than that, or is not text in UTF-8 (with the line)
std::string read_input_text(const std::string& path, const std::string& kind,
                            std::uintmax_t largest);

/// The bytes of such a file, which may be no text.
/// @throws InputError when the file does not exist, is a folder or a device, may not be read, or is
/// larger than that
std::string read_input_bytes(const std::string& path, const std::string& kind,
                             std::uintmax_t largest);

/// The text in such bytes, without a byte order mark.
/// @throws InputError where they are not text in UTF-8 (with the line)
std::string text_of_bytes(std::string bytes, const std::string& path, const std::string& kind);

/// Text with its ASCII letters in lower case.
std::string lower_case(std::string_view text);

/// True if a text has a control character other than tabulators and line ends.
bool has_control_character(const std::string& text);

}  // namespace furrow
