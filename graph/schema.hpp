// SPDX-License-Identifier: BSD-3-Clause
// Parameters as data: name, unit, doc and range are written once, beside the member they set; type
// and default are read from the member and a default-constructed Params.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace posevote::graph {

/// What a value must fulfil beyond its type. Made by the functions below.
struct Constraint {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false;             ///< low itself is not allowed
  std::vector<std::string> choices;  ///< for strings

  /// "> 0", "in [0, 1]", "one of mm, m"; empty where everything is allowed.
  std::string text() const;
  /// Nothing if allowed, else what was expected.
  std::optional<std::string> violated_by(double value) const;
  std::optional<std::string> violated_by(const std::string& value) const;
};

Constraint anything();
Constraint greater_than(double low);
Constraint at_least(double low);
Constraint in_range(double low, double high);
Constraint one_of(std::vector<std::string> choices);

/// One parameter of one node type. `set` and `get` work on a type-erased Params.
struct ParamSpec {
  std::string name;
  std::string type;  ///< "bool", "int", "number" or "string"
  std::string unit;  ///< "m", "rad", "deg", "x resolution", "" ...
  std::string doc;
  std::string default_text;
  Constraint constraint;
  /// Parses text into the member; nothing if it went well, else "must be ...".
  std::function<std::optional<std::string>(void* params, std::string_view text)> set;
  std::function<std::string(const void* params)> get;
  bool expert = false;  ///< for those who know the method from within; listed apart
};

/// Text to value and back, the same on every locale. `parse` is empty-handed where the text is not
/// of the type: "1.5" is no int, "yes" no bool, "0x10" and "010" no numbers.
template <class T>
struct Scalar;

template <>
struct Scalar<bool> {
  static constexpr const char* kName = "bool";
  static std::optional<bool> parse(std::string_view text);
  static std::string print(bool value);
};
template <>
struct Scalar<int> {
  static constexpr const char* kName = "int";
  static std::optional<int> parse(std::string_view text);
  static std::string print(int value);
};
template <>
struct Scalar<double> {
  static constexpr const char* kName = "number";
  static std::optional<double> parse(std::string_view text);
  static std::string print(double value);
};
template <>
struct Scalar<std::string> {
  static constexpr const char* kName = "string";
  static std::optional<std::string> parse(std::string_view text);
  static std::string print(const std::string& value);
};

/// The closest of `known` to a misspelt `name`, or "" if none is close.
std::string closest_name(const std::string& name, const std::vector<std::string>& known);

/// Builds the ParamSpec of one value of a Params. `access` leads to it: a member pointer, or a
/// function as `[](Params& p) -> double& { return p.terms.weight; }` for what lies deeper.
template <class Params, class Access>
ParamSpec make_param(std::string name, Access access, std::string unit, std::string doc,
                     Constraint constraint) {
  using T = std::decay_t<std::invoke_result_t<Access, Params&>>;
  Params defaults{};
  ParamSpec spec{std::move(name),
                 Scalar<T>::kName,
                 std::move(unit),
                 std::move(doc),
                 Scalar<T>::print(std::invoke(access, defaults)),
                 constraint,
                 {},
                 {}};
  spec.set = [access, constraint](void* params,
                                  std::string_view text) -> std::optional<std::string> {
    const std::optional<T> value = Scalar<T>::parse(text);
    if (!value) return std::string("expected ") + Scalar<T>::kName;
    if constexpr (std::is_same_v<T, std::string>) {
      if (auto expected = constraint.violated_by(*value)) return expected;
    } else if constexpr (!std::is_same_v<T, bool>) {
      if (auto expected = constraint.violated_by(static_cast<double>(*value))) return expected;
    }
    std::invoke(access, *static_cast<Params*>(params)) = *value;
    return std::nullopt;
  };
  spec.get = [access](const void* params) {
    Params copy = *static_cast<const Params*>(params);  // `access` may ask for what it can change
    return Scalar<T>::print(std::invoke(access, copy));
  };
  return spec;
}

}  // namespace posevote::graph
