// The rows of the format are made of these: a value with its reader, its JSON Schema and its words; a key, which puts a
// value into a field; an object, which is a list of keys and perhaps a rule about several of them.
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_format.h"
#include "scene/scene_node.h"
#include "world/up.h"

namespace drape {

struct ValueText {
    std::string schema;                        ///< members of its JSON Schema, without braces
    std::string words;                         ///< Markdown
    std::vector<const Definition*> uses = {};  ///< the definitions that `schema` refers to
};

template <class T>
struct Value {
    ValueText text;
    /// Leaves the field alone where nothing is, reports what does not fit, returns whether the field can be relied on.
    std::function<bool(const SceneNode&, T&)> read;
    std::function<std::string(const T&)> write = {};  ///< JSON of a default; empty: no default is published
};

Value<double> number(const Range& range);
Value<std::uint32_t> integer(std::uint32_t low, std::uint32_t high);
Value<std::uint32_t> one_of(std::vector<std::uint32_t> allowed);
Value<std::array<double, 2>> two_numbers(const Range& range);
Value<std::array<std::uint32_t, 2>> two_integers(std::uint32_t low, std::uint32_t high);
Value<Vec3> three_numbers(const Range& range);
/// Reads a vector that is not zero; the field becomes its unit vector.
Value<Vec3> unit_vector();
Value<bool> boolean();
Value<std::string> text();

std::string quoted(std::string_view text);
std::string reference_schema(const Definition& definition);

template <class T>
Value<std::optional<T>> optional(const Value<T>& value) {
    return {value.text, [value](const SceneNode& node, std::optional<T>& field) {
                T read{};
                const bool fits = value.read(node, read);
                if (node && fits) field = read;
                return fits;
            }};
}

template <class T>
Value<T> choice(std::span<const Spelling<T>> spellings) {
    Value<T> value;
    for (const Spelling<T>& spelling : spellings) {
        value.text.schema += (value.text.schema.empty() ? "\"enum\": [" : ", ") + quoted(spelling.name);
        value.text.words += (value.text.words.empty() ? "" : ", ") + ("`" + quoted(spelling.name) + "`");
    }
    value.text.schema += "]";
    value.read = [spellings](const SceneNode& node, T& field) { return node.read_choice(field, spellings); };
    value.write = [spellings](const T& field) {
        for (const Spelling<T>& spelling : spellings)
            if (spelling.value == field) return quoted(spelling.name);
        return std::string();
    };
    return value;
}

template <class T>
Value<T> without_default(Value<T> value) {
    value.write = nullptr;
    return value;
}

// A default that has a direction becomes this in another world.
inline void turn(Up up, Vec3& v) { v = in_world(up, v); }
inline void turn(Up up, Placement& placement) { turn(up, placement.v); }
inline void turn(Up up, std::vector<DirectionalLight>& lights) {
    for (DirectionalLight& light : lights) turn(up, light.direction);
}

/// Returns the same value with a default that turns with the scene's world.
template <class T>
Value<T> turned(const Value<T>& value) {
    Value<T> result = value;
    result.read = [value](const SceneNode& node, T& field) {
        if (node || node.up() == Up::y) return value.read(node, field);
        turn(node.up(), field);
        if (value.write) node.note_own_default(value.write(field));
        return value.read(node, field);
    };
    return result;
}

/// An array of `least` to `most` items; an error says that `what` was expected; `fresh` is an element without keys.
template <class T>
Value<std::vector<T>> list(const Value<T>& item, std::string_view what, std::size_t least, std::size_t most,
                           const T& fresh = {}) {
    Value<std::vector<T>> value;
    value.text = item.text;
    value.text.schema = "\"type\": \"array\", \"items\": {" + item.text.schema + "}";
    if (least > 0) value.text.schema += ", \"minItems\": " + std::to_string(least);
    value.text.schema += ", \"maxItems\": " + std::to_string(most);
    const std::string count = least > 0 ? std::to_string(least) + " to " : "at most ";
    value.text.words = "array of " + count + std::to_string(most) + " " + item.text.words;
    value.read = [item, what, least, most, fresh](const SceneNode& node, std::vector<T>& field) {
        if (!node.open_array(what, least, most)) return !node;
        field.assign(node.size(), fresh);
        bool fits = true;
        for (std::size_t i = 0; i < field.size(); ++i) fits = item.read(node.element(i), field[i]) && fits;
        return fits;
    };
    value.write = [item](const std::vector<T>& field) {
        std::string json;
        for (const T& element : field) json += (json.empty() ? "" : ", ") + item.write(element);
        return "[" + json + "]";
    };
    return value;
}

/// A value with a name of its own, which several keys have. It lives as long as the format.
template <class T>
struct Named {
    Named(std::string_view name, std::string_view help, const Value<T>& form)
        : definition{name, help, form.text.schema, form.text.words, {}, {}, form.text.uses},
          value{{reference_schema(definition), "[" + std::string(name) + "](#values)", {&definition}},
                form.read,
                form.write} {}
    Named(const Named&) = delete;
    operator const Value<T>&() const { return value; }

    Definition definition;
    Value<T> value;
};

/// The members of an object as its rule sees them: they are read already.
class Members {
  public:
    explicit Members(const SceneNode& object) : object_(object) {}
    const SceneNode& object() const { return object_; }
    SceneNode operator[](std::string_view key) const { return object_.member(key); }
    /// Returns whether the fields of all these keys can be relied on.
    bool fit(std::initializer_list<std::string_view> keys) const;
    bool all_fit() const { return unfit_.empty(); }
    void add_unfit(std::string_view key) { unfit_.push_back(key); }

  private:
    const SceneNode& object_;
    std::vector<std::string_view> unfit_;
};

template <class Object>
struct Key {
    using Read = std::function<bool(const SceneNode&, Object&)>;

    /// An error says that `required` was expected where the key is missing; empty: it may be missing.
    template <class Base, class Field>
    requires std::derived_from<Object, Base> Key(std::string_view name, Field Base::*field,
                                                 const std::type_identity_t<Value<Field>>& value, std::string_view help,
                                                 std::string_view required = {})
        : Key(
              name, value.text,
              [field, reads = value.read](const SceneNode& node, Object& object) { return reads(node, object.*field); },
              help, required) {
        if (!value.write || !required.empty()) return;
        text.default_value = value.write(Object{}.*field);
        write = [field, writes = value.write](const Object& object) { return writes(object.*field); };
    }
    Key(std::string_view name, const ValueText& value, Read read_value, std::string_view help,
        std::string_view required = {})
        : text{name, help, value.schema, value.words, {}, !required.empty()}, uses(value.uses) {
        read = [read_value = std::move(read_value), required](const SceneNode& node, Object& object) {
            return node || required.empty() ? read_value(node, object) : node.fail_expected(required);
        };
    }

    /// Returns the same key of an object around this one; `part` finds this one in it.
    template <class Whole, class Part>
    Key<Whole> within(Part part) const {
        Key<Whole> key(
            {}, {}, [part, reads = read](const SceneNode& node, Whole& whole) { return reads(node, part(whole)); }, {});
        key.text = text;
        key.uses = uses;
        return key;
    }

    KeyText text;
    std::vector<const Definition*> uses;
    Read read;
    std::function<std::string(const Object&)> write = {};  ///< empty: the key has no default
};

/// An object of the format. It lives as long as the format.
template <class T>
class Object {
  public:
    /// Checks what concerns several keys, after they were read; returns whether the object can be relied on.
    using Rule = bool (*)(const Members&, T&);

    Object(std::string_view name, std::string_view help, std::vector<Key<T>> keys, Rule rule = nullptr,
           std::string_view further_schema = {}, std::string_view other_keys = {})
        : keys_(std::move(keys)), rule_(rule) {
        definition_ = {name, help, std::string(further_schema), {}, {}, std::string(other_keys), {}};
        for (const Key<T>& key : keys_) {
            definition_.keys.push_back(key.text);
            definition_.uses.insert(definition_.uses.end(), key.uses.begin(), key.uses.end());
        }
        value_.text = {
            reference_schema(definition_), "[" + std::string(name) + "](#" + std::string(name) + ")", {&definition_}};
        value_.read = [this](const SceneNode& node, T& object) { return read(node, object); };
        value_.write = [this](const T& object) { return written(object); };
    }
    Object(const Object&) = delete;

    bool read(const SceneNode& node, T& object) const {
        if (!node.open_object(definition_)) return !node;
        node.note_missing(definition_);
        Members members(node);
        for (const Key<T>& key : keys_)
            if (!key.read(node.member(key.text.name), object)) members.add_unfit(key.text.name);
        return (rule_ == nullptr || rule_(members, object)) && members.all_fit();
    }
    operator const Value<T>&() const { return value_; }
    const Definition& definition() const { return definition_; }

  private:
    /// Returns the keys that have other values than their defaults.
    std::string written(const T& object) const {
        std::string json;
        for (const Key<T>& key : keys_) {
            const std::string value = key.write ? key.write(object) : key.text.default_value;
            if (value != key.text.default_value)
                json += (json.empty() ? "" : ", ") + quoted(key.text.name) + ": " + value;
        }
        return "{" + json + "}";
    }

    Definition definition_;
    std::vector<Key<T>> keys_;
    Rule rule_;
    Value<T> value_;
};

template <class T>
Value<T> turned(const Named<T>& named) {
    return turned(named.value);
}
template <class T>
Value<T> turned(const Object<T>& object) {
    return turned(static_cast<const Value<T>&>(object));
}

}  // namespace drape
