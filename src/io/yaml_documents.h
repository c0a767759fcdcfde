// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include <yaml-cpp/mark.h>

namespace furrow {

/// "a.yaml, line 3"; the path alone where nothing is known of the line.
std::string place(const std::string& path, const YAML::Mark& mark);

/// Refuses a text of several documents. Looked at document by document, because YAML::LoadAll
/// (yaml-cpp 0.7) does not come to an end where a document begins with what none can begin with.
/// @param path of the file, for the message
/// @throws InputError for a second document with content, and where no document can be read
/// @throws YAML::Exception for what is no YAML
void require_one_document(const std::string& path, const std::string& text);

}  // namespace furrow
