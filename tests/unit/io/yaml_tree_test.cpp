// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/yaml_tree.h"

#include <gmock/gmock.h>

#include <chrono>

#include "scratch.h"
#include "tests/support/error_of.h"

namespace furrow::yaml_tree_test {
namespace {

using test::error_of;
using ::testing::HasSubstr;

class YamlTreeTest : public ::testing::Test {
 protected:
  YamlTree read(const std::string& text) { return read_yaml(scratch_.file("a.yaml", text)); }
  std::string refusal(const std::string& text) {
    return error_of([&] { read(text); });
  }
  Scratch scratch_;
};

/// Nine lists of nine aliases of the list before stand for 9^9 values.
std::string alias_bomb() {
  std::string text = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int n = 1; n < 9; ++n) {
    text += "a" + std::to_string(n) + ": &a" + std::to_string(n) + " [";
    for (int k = 0; k < 9; ++k) text += (k ? ", *a" : "*a") + std::to_string(n - 1);
    text += "]\n";
  }
  return text;
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int n = 0; n < times; ++n) all += text;
  return all;
}

/// Two of them are the fuzz target's: YAML::LoadAll takes memory without end.
TEST_F(YamlTreeTest, InvalidFirstCharactersAreRefused) {
  for (const char* text :
       {",\n  G: 1e6\n  bulk: 49e6\n", "title: a\n,\n  G: 1e6\n", "]\na: 1\n", "a: 1\n}\n"})
    EXPECT_THAT(refusal(text), HasSubstr("is not YAML")) << text;
}

TEST_F(YamlTreeTest, OrdinaryFilesAreRead) {
  EXPECT_EQ(read("---\na: 1  # one\n...\n").find("a")->text, "1");
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "a: ü\r\nb: [1, 2]\r\n")
                .find("b")
                ->items.at(1)
                .text,
            "2");
  // anchors with aliases are YAML, and so is a file that ends with ---
  const YamlTree tree = read("a: &a [1, 2]\nb: *a\nc: {d: *a}\n---\n# nothing\n");
  EXPECT_EQ(tree.find("c")->find("d")->items.at(0).text, "1");
  EXPECT_EQ(tree.find("b")->origin, scratch_.path("a.yaml") + ", line 2");
  EXPECT_EQ(read("a:\n" + repeated("- [1, 2, 3, 4]\n", 50000)).find("a")->items.size(), 50000u);
}

TEST_F(YamlTreeTest, OtherFilesAreRefusedWithTheirLine) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "a.yaml is empty"},
      {"---\n---\n", "a.yaml is empty"},
      {"~\n", "a.yaml is empty"},
      {"a: 1\n---\nb: 2\n", "a.yaml, line 3 begins a second document (after ---)"},
      {"a: 1\n...\nb: 2\n", "a.yaml, line 3 begins a second document"},
      {"a: 1\n b: 2\n", "a.yaml, line 2 is not YAML: "},
      {"a: [1, 2\n", "is not YAML: "},
      {"a: *b\n", "a.yaml, line 1 is not YAML: "},
      {"a:\n\tb: 1\n", "is not YAML: "},
      {"a: @1\n", "is not YAML: "},
      {"%YAML 9.9\n---\na: 1\n", "is not YAML: "},
      {"just words\n", "a.yaml, line 1 is not a map"},
      {"- a\n", "a.yaml, line 1 is not a map"},
      {"a: 1\na: 2\n", "a.yaml, line 2: keyword 'a' is given twice"},
      {"b: {a: 1, 'a': 2}\n", "line 1: keyword 'a' is given twice"},
      {"? [1, 2]\n: 3\n", "a.yaml, line 1 has a key that is not a word"},
      {"a:\n", "line 1: keyword 'a' has no value"},
      {"a: null\n", "line 1: keyword 'a' has no value"},
      {"a: [1, ~]\n", "a.yaml, line 1 has an empty value"},
      {"a: \"x\\0y\"\n", "a.yaml, line 1 has a control character in a text"},
      {"\"a\\e\": 1\n", "a.yaml, line 1 has a control character in a text"},
      {"a: " + std::string(5000, 'x') + "\n",
       "line 1 has a text of 5000 bytes; allowed: at most 4096"},
      {std::string(5000, 'x') + ": 1\n", "is not YAML: "},
      {"a: " + std::string(40, '[') + std::string(40, ']') + "\n", "is nested too deep"},
      {"a: " + std::string(4000, '[') + std::string(4000, ']') + "\n", "allowed: "},
      {"a: &a [*a]\n", "an alias (*name) must not be inside its own anchor (&name)"},
      {"a: &a {b: *a}\n", "an alias (*name) must not be inside its own anchor (&name)"},
      {alias_bomb(), "a.yaml has aliases that stand for more than 100000 values"},
      {std::string(5 << 20, '#'), "a.yaml has 5242880 bytes; allowed: a YAML file"}};
  for (const auto& [text, message] : cases) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(refusal(text), HasSubstr(message)) << text.substr(0, 200);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  }
}

TEST_F(YamlTreeTest, UnknownKeyIsNamedForEveryKindOfValue) {
  Schema schema("run");
  schema.text("material", "a file");
  for (const char* value : {"1", "[1, 2]", "{type: confined}", "[[1], [2]]"})
    EXPECT_THAT(
        error_of(
            [&] { read_map(schema, read("material: a\npaths: " + std::string(value)), {"path"}); }),
        HasSubstr("a.yaml, line 2: run has no keyword 'paths'; allowed: material, path; did "
                  "you mean 'path'?"));
}

}  // namespace
}  // namespace furrow::yaml_tree_test
