// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/formats/yaml_documents.h"

#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include "furrow/core/error.h"

namespace furrow {

namespace {

/// Finds the place where a document begins, and whether it holds anything.
class DocumentStart : public YAML::EventHandler {
 public:
  using Mark = YAML::Mark;
  using Text = std::string;
  using Style = YAML::EmitterStyle::value;

  const Mark& mark() const { return mark_; }
  bool has_content() const { return !content_.is_null(); }
  const Mark& content() const { return content_; }

  void OnDocumentStart(const Mark& mark) override {
    mark_ = mark;
    content_ = Mark::null_mark();
  }
  void OnDocumentEnd() override {}
  void OnNull(const Mark&, YAML::anchor_t) override {}
  void OnAlias(const Mark& mark, YAML::anchor_t) override { add(mark); }
  void OnScalar(const Mark& mark, const Text&, YAML::anchor_t, const Text&) override { add(mark); }
  void OnSequenceStart(const Mark& mark, const Text&, YAML::anchor_t, Style) override { add(mark); }
  void OnSequenceEnd() override {}
  void OnMapStart(const Mark& mark, const Text&, YAML::anchor_t, Style) override { add(mark); }
  void OnMapEnd() override {}

 private:
  void add(const Mark& mark) {
    if (content_.is_null()) content_ = mark;
  }

  Mark mark_ = Mark::null_mark(), content_ = Mark::null_mark();
};

}  // namespace

std::string place(const std::string& path, int line) {
  return line < 0 ? path : fmt::format("{}, line {}", path, line + 1);
}

void require_one_document(const std::string& path, const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  DocumentStart start;
  for (int last_position = -1; parser.HandleNextDocument(start);) {
    if (start.mark().pos <= last_position)
      throw InputError(place(path, start.mark().line), "is not YAML: nothing can begin like this",
                       "key: value", "look for a comma, a colon or a bracket too many");
    if (last_position >= 0 && start.has_content())
      throw InputError(place(path, start.content().line), "begins a second document (after ---)",
                       "one document in a file", "put it into a separate file");
    last_position = start.mark().pos;
  }
}

}  // namespace furrow
