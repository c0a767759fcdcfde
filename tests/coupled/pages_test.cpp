// SPDX-License-Identifier: GPL-2.0-or-later
// The page of every style says what the code declares: each keyword has its row, with unit and
// default; each output has its row, with name, unit and meaning; no row describes what is gone.

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "coupling/liggghts/style_registry.h"

namespace furrow::test {
namespace {

using namespace coupling;
using Row = std::vector<std::string>;

std::string trimmed(const std::string& text, const std::string& blank = " ") {
  const std::size_t first = text.find_first_not_of(blank);
  const std::size_t last = text.find_last_not_of(blank);
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Cells of "| a | b |"; an escaped bar is text.
Row cells(const std::string& line) {
  Row result(1);
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '|' && line[i - 1] == '\\') {
      result.back().back() = '|';
    } else if (line[i] == '|') {
      result.emplace_back();
    } else {
      result.back() += line[i];
    }
  }
  if (trimmed(result.back()).empty()) result.pop_back();  // behind the last bar
  for (std::string& cell : result) cell = trimmed(cell);
  return result;
}

std::string line(const Row& row) {
  std::string text = "|";
  for (const std::string& cell : row) {
    text += cell.empty() ? "" : " ";
    for (const char c : cell) text += c == '|' ? "\\|" : std::string(1, c);
    text += " |";
  }
  return text + "\n";
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string folder() { return FURROW_SOURCE_DIR "/coupling/"; }

/// The rows of the first table whose head is this, without head and rule.
std::vector<Row> table(const std::string& page, const Row& head) {
  std::ifstream file(folder() + page);
  EXPECT_TRUE(file.is_open()) << page << " is missing";
  std::vector<Row> rows;
  std::string line;
  while (std::getline(file, line) && (line.empty() || line[0] != '|' || cells(line) != head)) {
  }
  std::getline(file, line);  // the rule below the head
  while (std::getline(file, line) && !line.empty() && line[0] == '|') rows.push_back(cells(line));
  return rows;
}

void expect_keywords(const Style& style) {
  std::map<std::string, Row> rows;
  for (const Row& row : table(style.page, {"keyword", "unit", "default", "meaning"})) {
    ASSERT_EQ(row.size(), 4u) << style.page << ": " << fmt::format("{}", fmt::join(row, " | "));
    rows[trimmed(row[0], "`")] = row;
  }
  const Schema schema = style.schema();
  for (const Key& key : schema.keys()) {
    EXPECT_TRUE(rows.count(key.name)) << style.page << " has no row for " << key.name;
    if (!rows.count(key.name)) continue;
    const Row& row = rows[key.name];
    EXPECT_EQ(row[1], key.unit) << style.page << ", " << key.name;
    EXPECT_EQ(trimmed(row[2], "`"), fmt::format("{}", fmt::join(key.default_values, " ")))
        << style.page << ", " << key.name;
    EXPECT_FALSE(row[3].empty()) << style.page << ", " << key.name;
    for (const std::string& word : key.choices)
      EXPECT_NE(row[3].find('`' + word + '`'), std::string::npos) << style.page << ", " << word;
    rows.erase(key.name);
  }
  for (const auto& [name, row] : rows)
    ADD_FAILURE() << style.page << " describes " << name << ", which " << schema.subject()
                  << " does not have";
}

/// Entries of a vector have a number beside their name; channels and variables their name alone.
void expect_outputs(const Style& style) {
  const OutputTable outputs = style.outputs();
  std::vector<Row> declared;
  for (const Channel& row : outputs.rows) {
    declared.push_back({'`' + row.name + '`', row.unit, row.meaning});
    if (outputs.what == "entry")
      declared.back().insert(declared.back().begin(), fmt::format("`f_ID[{}]`", declared.size()));
  }
  const std::map<std::string, Row> heads = {{"entry", {"entry", "name", "unit", "meaning"}},
                                            {"channel", {"channel", "unit", "meaning"}},
                                            {"variable", {"variable", "unit", "meaning"}}};
  for (const auto& [what, head] : heads) {
    std::vector<Row> expected;
    if (what == outputs.what) expected = declared;
    std::string text = line(head) + line(Row(head.size(), "---"));
    for (const Row& row : expected) text += line(row);
    EXPECT_EQ(table(style.page, head), expected) << style.page << ": the table must be\n" << text;
  }
}

TEST(Pages, EveryStyleHasAPageThatSaysWhatTheCodeDeclares) {
  for (const Style& style : styles()) {
    if (style.kind == "internal") continue;
    ASSERT_FALSE(style.page.empty()) << style.name << " has no page";
    expect_keywords(style);
    expect_outputs(style);
  }
}

TEST(Pages, EveryPageIsThatOfAStyleAndIsListed) {
  std::set<std::string> pages;
  const std::string list = text_of(folder() + "README.md");
  for (const Style& style : styles()) {
    if (style.page.empty()) continue;
    pages.insert(folder() + style.page);
    EXPECT_NE(list.find('[' + style.name + "](" + style.page + ')'), std::string::npos)
        << "coupling/README.md does not list " << style.name;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder())) {
    const std::string path = entry.path();
    if (entry.path().extension() != ".md" || entry.path().filename() == "README.md") continue;
    EXPECT_TRUE(pages.count(path)) << path;
  }
}

/// Of all pages of the project.
std::vector<std::filesystem::path> all_pages() {
  const std::filesystem::path root = FURROW_SOURCE_DIR;
  std::vector<std::filesystem::path> pages = {root / "README.md", root / "CONTRIBUTING.md"};
  for (const char* part : {"src", "coupling", "inputs", "tests", "postproc"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / part))
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
  return pages;
}

TEST(Pages, LinksLeadToFiles) {
  const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  int links = 0;
  for (const std::filesystem::path& page : all_pages()) {
    const std::string content = text_of(page);
    EXPECT_FALSE(content.empty()) << page;
    for (std::sregex_iterator found(content.begin(), content.end(), link), end; found != end;
         ++found, ++links)
      EXPECT_TRUE(std::filesystem::exists(page.parent_path() / (*found)[1].str()))
          << page << " links to " << (*found)[1];
  }
  EXPECT_GT(links, 0);
}

TEST(Styles, NamesAreUnambiguousAndDeclarationsComplete) {
  std::set<std::string> names;
  for (const Style& style : styles()) {
    EXPECT_TRUE(names.insert(style.name).second) << style.name;
    for (const std::string& former : style.former_names)
      EXPECT_TRUE(names.insert(former).second) << former;
    EXPECT_EQ((style.create_fix != nullptr) + (style.run_command != nullptr) +
                  (style.add_model != nullptr),
              1)
        << style.name;
    EXPECT_EQ(find_style(style.name), &style);
    std::set<std::string> keys, outputs;
    const Schema schema = style.schema();
    const OutputTable table = style.outputs();
    for (const Key& key : schema.keys()) {
      EXPECT_TRUE(keys.insert(key.name).second) << style.name << ", " << key.name;
      EXPECT_FALSE(key.meaning.empty()) << style.name << ", " << key.name;
    }
    for (const Channel& row : table.rows) {
      EXPECT_TRUE(outputs.insert(row.name).second) << style.name << ", " << row.name;
      EXPECT_FALSE(row.meaning.empty()) << style.name << ", " << row.name;
    }
  }
}

TEST(Styles, ErrorsNameTheStylesOfAKind) {
  EXPECT_EQ(style_names({"rig"}), "wheel/rig");
  EXPECT_EQ(style_names({"wheel"}), "tyre/brick, tyre/darnell or wheel/rigid");
  EXPECT_EQ(style_names({"wheel", "body"}), "tyre/brick, tyre/darnell, wheel/rigid or plate/rigid");
  EXPECT_EQ(find_style("contact/bodies"), find_style("contact/continuum"));
  EXPECT_EQ(find_style("nve/sphere"), nullptr);
}

}  // namespace
}  // namespace furrow::test
