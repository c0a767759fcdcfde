// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Outputs are declared once: name, unit, meaning and the function that gives the value. Results
/// files, script vectors, pages and tests all use that one declaration.

#include <initializer_list>
#include <string>
#include <vector>

namespace furrow {

/// Description of a reported number.
struct Channel {
  std::string name;     ///< "sinkage": a name in a file, unique in its list
  std::string unit;     ///< "m"; "" for pure numbers
  std::string meaning;  ///< "ground level minus lowest point of the wheel without grousers"
};

/// The outputs of one producer, in the order in which they are reported. The functions read a
/// Source (which may be const): the producer itself, or what it has gathered for one row.
///   const Outputs<Plate>& Plate::outputs() {
///     static const Outputs<Plate> list = {
///         {"sinkage", "m", "ground level minus lower face", [](Plate& plate) { return ...; }},
///     };
///     return list;
///   }
template <class Source>
class Outputs {
 public:
  struct Output {
    std::string name;
    std::string unit;
    std::string meaning;
    double (*value)(Source&);
  };

  Outputs() = default;
  Outputs(std::initializer_list<Output> outputs) : outputs_(outputs) {}

  std::size_t size() const { return outputs_.size(); }
  double value(std::size_t n, Source& source) const { return outputs_[n].value(source); }

  /// All values, in the order of channels().
  std::vector<double> values(Source& source) const {
    std::vector<double> row;
    row.reserve(size());
    for (const Output& output : outputs_) row.push_back(output.value(source));
    return row;
  }

  std::vector<Channel> channels() const {
    std::vector<Channel> list;
    for (const Output& output : outputs_)
      list.push_back({output.name, output.unit, output.meaning});
    return list;
  }

 private:
  std::vector<Output> outputs_;
};

}  // namespace furrow
