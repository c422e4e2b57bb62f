// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/probability.hpp"
#include "proto/base/quantity.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/time.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::device {

// The keys of a value are listed once, for reading and for printing:
//     template <typename Keys, typename Value>
//     void list_keys(Keys& keys, Value& value) { keys.value("mass", value.mass_kg, mass); }

/// What a quantity with a unit may be, both ends included.
struct Range {
    const base::QuantityKind& kind;
    double least;
    double most;
};

/// What a number without a unit may be.
struct Plain {
    double least;
    double most;
};

/// What a time may be, both ends included.
struct Times {
    base::Duration least;
    base::Duration most;
};

/// Reads those keys that are there; the others keep their values.
class KeyReader {
public:
    explicit KeyReader(base::TableReader& table) : table_{table} {}

    void value(std::string_view key, double& target, const Range& range);
    void value(std::string_view key, double& target, const Plain& range);
    void value(std::string_view key, base::Duration& target, const Times& range);
    void value(std::string_view key, base::Duration& target, base::Duration most)
    {
        value(key, target, Times{base::Duration{0}, most});
    }
    void value(std::string_view key, base::Probability& target);
    template <typename T, typename Limit>
    void value(std::string_view key, std::optional<T>& target, const Limit& limit)
    {
        T read = target.value_or(T{});
        if (table_.find(key) == nullptr) return;
        value(key, read, limit);
        target = read;
    }

    /// A table in the table: `list(KeyReader&)` lists its keys.
    template <typename List>
    void group(std::string_view key, List list)
    {
        const base::Node* node = table_.find(key);
        if (node == nullptr) return;
        const auto* entries = std::get_if<base::Node::Table>(&node->value);
        if (entries == nullptr) return base::complain_of(*node, "a table", table_.reading());
        base::TableReader inner{*entries, node->place, table_.reading()};
        KeyReader keys{inner};
        list(keys);
        inner.finish();
    }

private:
    base::TableReader& table_;
};

/// Prints all of them, one to a line; what is not set is left out.
class KeyPrinter {
public:
    explicit KeyPrinter(std::string prefix = {}) : prefix_{std::move(prefix)} {}

    void value(std::string_view key, double value, const Range& range);
    void value(std::string_view key, double value, const Plain& range);
    void value(std::string_view key, base::Duration value, const Times& range);
    void value(std::string_view key, base::Duration value, base::Duration most);
    void value(std::string_view key, base::Probability value);
    template <typename T, typename Limit>
    void value(std::string_view key, const std::optional<T>& set, const Limit& limit)
    {
        if (set) value(key, *set, limit);
    }

    template <typename List>
    void group(std::string_view key, List list)
    {
        KeyPrinter keys{prefix_ + std::string{key} + '.'};
        list(keys);
        text_ += keys.text_;
    }

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    void line(std::string_view key, const std::string& value);

    std::string prefix_;
    std::string text_;
};

} // namespace hapnet::device
