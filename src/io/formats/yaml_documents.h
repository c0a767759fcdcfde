// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

namespace furrow {

/// Place "a.yaml, line 3" for the line 2 of a YAML::Mark, which counts from 0; the path alone for
/// that of an unknown place, -1.
std::string place(const std::string& path, int line);

/// Refuses a text of several documents. Looked at document by document, because YAML::LoadAll
/// (yaml-cpp 0.7) does not come to an end where a document begins with what none can begin with.
/// @param path of the file, for the message
/// @throws InputError for a second document with content, and where no document can be read
/// @throws YAML::Exception for what is no YAML
void require_one_document(const std::string& path, const std::string& text);

}  // namespace furrow
