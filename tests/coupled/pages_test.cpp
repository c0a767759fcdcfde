// SPDX-License-Identifier: GPL-2.0-or-later
// The page of every style matches its declaration in the code: the tables of keywords and of
// outputs have the declared rows, and the sections are those that every page has. Links lead to
// files.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/liggghts/styles/style_registry.h"

namespace furrow::test::pages_test {
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

/// Text of the values that a key allows: "> 0", "integer >= 1", "2 numbers", "`yes`, `no`".
std::string range_of(const Key& key) {
  if (!key.choices.empty()) return fmt::format("`{}`", fmt::join(key.choices, "`, `"));
  if (key.kind == Key::Kind::text) return "";
  const bool any = key.range.text() == furrow::Range::any().text();
  const std::string limits = any ? "" : key.range.text();
  if (key.kind == Key::Kind::integer) return any ? "integer" : "integer " + limits;
  if (key.kind == Key::Kind::number) return limits;
  return fmt::format("{}numbers{}{}", key.count == 0 ? "" : fmt::format("{} ", key.count),
                     any ? "" : ", each ", limits);
}

Row row_of(const Key& key) {
  std::string value = key.required ? "required" : "optional";
  if (!key.default_values.empty()) value = fmt::format("`{}`", fmt::join(key.default_values, " "));
  return {'`' + key.name + '`', key.unit, range_of(key), value, key.meaning};
}

std::string text_of(const Row& head, const std::vector<Row>& rows) {
  std::string text = line(head) + line(Row(head.size(), "---"));
  for (const Row& row : rows) text += line(row);
  return text;
}

/// In any order: a page may begin with the keyword that matters most.
void expect_keywords(const Style& style) {
  const Row head = {"keyword", "unit", "range", "default", "meaning"};
  const Schema schema = style.schema();
  std::vector<Row> declared;
  for (const Key& key : schema.keys()) declared.push_back(row_of(key));
  std::vector<Row> sorted = declared, rows = table(style.page, head);
  std::sort(sorted.begin(), sorted.end());
  std::sort(rows.begin(), rows.end());
  EXPECT_EQ(rows, sorted) << style.page << ": the table must be\n" << text_of(head, declared);
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
                                            {"column", {"column", "unit", "meaning"}},
                                            {"variable", {"variable", "unit", "meaning"}}};
  for (const auto& [what, head] : heads) {
    std::vector<Row> expected;
    if (what == outputs.what) expected = declared;
    EXPECT_EQ(table(style.page, head), expected) << style.page << ": the table must be\n"
                                                 << text_of(head, expected);
  }
}

/// A page has these sections, in this order, and a description that can be read in some minutes.
void expect_sections(const Style& style) {
  constexpr int longest_description = 600;  // words, without code and tables
  std::ifstream file(folder() + style.page);
  std::vector<std::string> sections;
  int words = 0;
  bool code = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("```", 0) == 0) code = !code;
    if (code) continue;
    if (line.rfind("## ", 0) == 0) sections.push_back(line.substr(3));
    if (sections.empty() || sections.back() != "Description" || line.rfind("|", 0) == 0) continue;
    std::istringstream text(line);
    for (std::string word; text >> word;) ++words;
  }
  EXPECT_THAT(sections, testing::ElementsAre("Syntax", "Examples", "Description", "Output",
                                             "Restart", "Restrictions", "Related", "Default"))
      << style.page;
  EXPECT_LE(words, longest_description) << style.page << ": words of its description";
}

TEST(Pages, EveryStyleHasAPageThatMatchesItsDeclaration) {
  for (const Style& style : styles()) {
    if (style.kind == "internal") continue;
    ASSERT_FALSE(style.page.empty()) << style.name << " has no page";
    expect_sections(style);
    expect_keywords(style);
    expect_outputs(style);
  }
}

TEST(Pages, EveryPageBelongsToAStyleAndIsListed) {
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

/// Paths of all pages of the project.
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
  EXPECT_EQ(style_names({"wheel"}), "tyre/brick, tyre/darnell, wheel/mesh or wheel/rigid");
  EXPECT_EQ(style_names({"wheel", "body"}),
            "tyre/brick, tyre/darnell, wheel/mesh, wheel/rigid, plate/mesh or plate/rigid");
  EXPECT_EQ(find_style("contact/bodies"), find_style("contact/continuum"));
  EXPECT_EQ(find_style("nve/sphere"), nullptr);
}

}  // namespace
}  // namespace furrow::test::pages_test
