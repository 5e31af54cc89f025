// SPDX-License-Identifier: BSD-3-Clause
// What travels along an edge: an immutable value whose type was checked once, when the graph was
// built.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <typeindex>
#include <typeinfo>
#include <utility>
#include <vector>

namespace posevote::graph {

/// An immutable value of a type that only its producer and consumers know.
using Value = std::shared_ptr<const void>;

/// One value per object of a frame; slot i belongs to object i. How PerObject<T> travels.
using Slots = std::vector<Value>;

/// One T per object of a frame, in a fixed order. A node written for one T is lifted by the builder
/// over the slots of a PerObject<T> stream; a node that wants all objects at once takes
/// PerObject<T>.
template <class T>
struct PerObject {
  std::vector<std::shared_ptr<const T>> slots;

  std::size_t size() const { return slots.size(); }
  const T& operator[](std::size_t i) const { return *slots[i]; }
};

/// `posevote::Cloud` as "Cloud".
std::string type_name(const std::type_info& type);

/// The type of a stream: T, or one T per object.
struct StreamType {
  std::type_index element = typeid(void);
  bool per_object = false;
  std::string name;  ///< "Cloud" or "PerObject<Cloud>"

  friend bool operator==(const StreamType& a, const StreamType& b) {
    return a.element == b.element && a.per_object == b.per_object;
  }
};

/// How a C++ type is turned into a stream's type and value, and back.
template <class T>
struct StreamTraits {
  static StreamType type() { return {typeid(T), false, type_name(typeid(T))}; }
  static const T& unwrap(const Value& value) { return *static_cast<const T*>(value.get()); }
  static std::shared_ptr<const T> share(const Value& value) {
    return std::static_pointer_cast<const T>(value);
  }
  static Value wrap(T&& value) { return std::make_shared<const T>(std::move(value)); }
};

/// A node that hands a large T on as it came takes and returns the pointer: nothing is copied.
template <class T>
struct StreamTraits<std::shared_ptr<const T>> {
  static StreamType type() { return StreamTraits<T>::type(); }
  static std::shared_ptr<const T> unwrap(const Value& value) {
    return std::static_pointer_cast<const T>(value);
  }
  static Value wrap(std::shared_ptr<const T>&& value) {
    if (!value) throw std::logic_error("it returned no " + type().name);
    return std::move(value);
  }
};

template <class T>
struct StreamTraits<PerObject<T>> {
  static StreamType type() { return {typeid(T), true, "PerObject<" + type_name(typeid(T)) + ">"}; }
  static PerObject<T> unwrap(const Value& value) {
    PerObject<T> objects;
    for (const Value& slot : *static_cast<const Slots*>(value.get()))
      objects.slots.push_back(std::static_pointer_cast<const T>(slot));
    return objects;
  }
  static std::shared_ptr<const PerObject<T>> share(const Value& value) {
    return value ? std::make_shared<const PerObject<T>>(unwrap(value)) : nullptr;
  }
  static Value wrap(PerObject<T>&& objects) {
    return std::make_shared<const Slots>(objects.slots.begin(), objects.slots.end());
  }
};

}  // namespace posevote::graph

namespace posevote {
using graph::PerObject;
}
