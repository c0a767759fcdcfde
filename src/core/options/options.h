// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
/// Options are declared once: key, unit, range, meaning, default. Scripts, files, pages and errors
/// use this declaration.

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace furrow {

/// An interval of admissible numbers, each end open or closed.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  static Range any() { return {}; }
  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }
  static Range non_negative() {
    return {0.0, std::numeric_limits<double>::infinity(), false, false};
  }
  static Range closed(double lower, double upper) { return {lower, upper, false, false}; }
  static Range open(double lower, double upper) { return {lower, upper, true, true}; }
  static Range at_least(double lower) {
    return {lower, std::numeric_limits<double>::infinity(), false, false};
  }

  bool contains(double value) const;  ///< false for NaN and infinities
  std::string text() const;           ///< "> 0", "in [0, 0.5)", "any number"
};

/// Declaration of a keyword.
struct Key {
  enum class Kind { number, integer, numbers, choice, text, flag };

  std::string name;
  Kind kind = Kind::number;
  std::string unit;                  ///< "" for choices, texts and pure numbers
  Range range;                       ///< of every number
  std::size_t count = 1;             ///< values that follow; 0 (numbers only): as many as there are
  std::vector<std::string> choices;  ///< the admissible words of a choice
  std::string meaning;
  bool required = true;
  /// used when not required and not given; may be empty
  std::vector<std::string> default_values = {};
  bool may_change = false;  ///< true if a continued run can have another value

  std::string allowed() const;  ///< "a number > 0 [m]", "one of: towed, slip, torque"
};

/// A former name of a key. Accepted with a warning; the value is taken over under the key's name.
struct Alias {
  using Translation = std::string (*)(const std::string& value);

  std::string former;
  std::string key;
  Translation translation = nullptr;  ///< from the old value; none: it means the same
};

/// Translates a flag whose former name meant the opposite: "yes" becomes "no"; other words stay.
std::string inverted_flag(const std::string& value);

/// One key with its values as text, as found in a script or a file.
struct Entry {
  std::string key;
  std::vector<std::string> values;
  /// where it was written, "sand.yaml, line 12", for errors; empty if the reader adds it
  std::string origin = {};
};

class Options;

/// The declaration of all keys that one style, law or file section understands.
class Schema {
 public:
  /// @param subject names the owner in errors: "fix wheel/rigid", "law drucker_prager_cap"
  explicit Schema(std::string subject) : subject_(std::move(subject)) {}

  // Each call declares a required key, unless optional() or by_default() follows. Ask has() or
  // given() for an optional key without a default.
  Schema& number(const std::string& name, const std::string& unit, Range range,
                 const std::string& meaning);
  Schema& integer(const std::string& name, Range range, const std::string& meaning);
  Schema& numbers(const std::string& name, std::size_t count, const std::string& unit, Range range,
                  const std::string& meaning);
  Schema& choice(const std::string& name, std::vector<std::string> choices,
                 const std::string& meaning);
  Schema& text(const std::string& name, const std::string& meaning);
  /// key with the values yes and no, "no" unless given
  Schema& flag(const std::string& name, const std::string& meaning);
  /// makes the key declared last optional
  Schema& optional();
  /// makes the key declared last optional, with this value
  Schema& by_default(const std::string& value);
  Schema& by_default(double value);
  Schema& by_default(const std::vector<double>& values);
  /// lets the key declared last have another value when a run is continued from a checkpoint
  Schema& may_change();

  /// Another name of a key that is declared already. Readers of options with aliases print
  /// Options::warnings().
  Schema& alias(const std::string& former, const std::string& key,
                Alias::Translation translation = nullptr);

  const std::string& subject() const { return subject_; }
  const std::vector<Key>& keys() const { return keys_; }
  const std::vector<Alias>& aliases() const { return aliases_; }
  const Key* find(const std::string& name) const;

  /// Reads "key value(s) key value(s) ..." as a script line has it. @throws InputError
  Options read(const std::vector<std::string>& words) const;
  /// Reads entries as a file has them. @throws InputError
  Options read(const std::vector<Entry>& entries) const;
  /// Checks the words of a line before the script runs, when those with a '$' are still unknown. It
  /// ends where keys and values cannot be distinguished. Missing keys are no error. @throws
  /// InputError
  void check(const std::vector<std::string>& words) const;
  /// The table of keys for --help: a line for each with unit, range, default and meaning.
  std::string table() const;

 private:
  Schema& declare(Key key);
  const Alias* find_alias(const std::string& former) const;
  /// The key that an entry means, by its name or by a former one; null for an unknown name.
  const Key* resolve(const std::string& name) const;
  void accept(Options& options, const Key& key, const std::vector<std::string>& texts, bool given,
              const std::string& origin, const std::string& where) const;

  std::string subject_;
  std::vector<Key> keys_;
  std::vector<Alias> aliases_;
};

/// Values that passed their Schema.
class Options {
 public:
  double number(const std::string& key) const;
  long integer(const std::string& key) const;
  const std::vector<double>& numbers(const std::string& key) const;
  const std::string& text(const std::string& key) const;  ///< of a text, a choice or a flag
  bool flag(const std::string& key) const;
  bool given(const std::string& key) const;  ///< the user wrote it
  bool has(const std::string& key) const;    ///< given, or has a default

  const std::string& subject() const { return subject_; }
  /// Every declared key, with a value or without one.
  const std::vector<Key>& keys() const { return keys_; }
  /// Warnings about former names that were used: a sentence each, with the present name.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// The effective values, defaults included, in the order of declaration: "key value ...".
  std::vector<Entry> effective() const;
  /// Place of a key, "fix wheel/rigid, keyword 'mass'", after its origin if it has one; to build an
  /// InputError about a combination of keys.
  std::string where(const std::string& key) const;

 private:
  friend class Schema;
  struct Value {
    std::vector<std::string> texts;
    std::vector<double> numbers;
    bool given = false;
    std::string origin = {};
  };
  const Value& value(const std::string& key) const;

  std::string subject_;
  std::vector<Key> keys_;
  std::map<std::string, Value> values_;
  std::vector<std::string> warnings_;
};

}  // namespace furrow
