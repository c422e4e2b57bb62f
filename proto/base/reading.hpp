// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/document.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::base {

/// A function that returns the content of a file that a text names, or the reason why it cannot.
class OpenFile {
public:
    /// Opens no files.
    OpenFile() = default;
    template <std::invocable<const std::string&> Open>
    OpenFile(Open open) : open_{std::move(open)} // NOLINT(google-explicit-constructor)
    {}

    /// Returns the same function for a client that may name files but not read them: error messages
    /// quote none of their content.
    [[nodiscard]] OpenFile unquoted() const
    {
        OpenFile copy = *this;
        copy.is_quoted_ = false;
        return copy;
    }
    [[nodiscard]] bool is_quoted() const { return is_quoted_; }

    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(open_); }
    [[nodiscard]] Result<std::string> operator()(const std::string& name) const
    {
        return open_(name);
    }

private:
    std::function<Result<std::string>(const std::string& name)> open_;
    bool is_quoted_ = true;
};

/// Parses the value of an option on a command line. It is TOML, except that a text needs no quotes:
/// `5ms`, `{ law = "normal", sd = "3ms" }`, `["5%", "40/100"]`. With `is_bare` it is a number or a
/// truth value: `40`, `true`.
[[nodiscard]] tl::expected<Node, DocumentError> parse_option(std::string_view text, bool is_bare);

/// A function that returns advice on a key that its table does not have, for one kind of text:
/// "write it below [both], [up] or [down]". An empty result means that the list of the table's keys
/// is the best advice.
using AdviseOnKey = std::function<std::string(std::string_view key)>;

/// The state of reading one text. It keeps the first complaint about the text.
class Reading {
public:
    /// `source` names the text in complaints: "FILE:LINE:COLUMN: ...". Without `has_lines`, the
    /// text is an option, and complaints contain only its name: "up.delay: ...".
    explicit Reading(std::string source, OpenFile open = {}, bool has_lines = true)
        : source_{std::move(source)}, open_{std::move(open)}, has_lines_{has_lines}
    {}

    void complain(Place place, std::string_view what);
    /// Replaces the first complaint, if there is one.
    void complain_rather(Place place, std::string_view what);
    [[nodiscard]] bool is_good() const { return !complaint_; }
    [[nodiscard]] const std::optional<std::string>& complaint() const { return complaint_; }

    /// Sets the advice on unknown keys for all tables of this text.
    void advise_on_keys(AdviseOnKey advise) { advise_ = std::move(advise); }
    [[nodiscard]] std::string advice_on(std::string_view key) const
    {
        return advise_ ? advise_(key) : std::string{};
    }

    [[nodiscard]] Result<std::string> open(const std::string& name) const;
    /// Returns the error for a file that was opened: "FILE: line 3: ...". If the file is not to be
    /// quoted, the error contains only the line number. `what` begins with the line, if the error
    /// has one.
    [[nodiscard]] Error trouble_in(const std::string& file, std::string_view what) const;

private:
    std::string source_;
    OpenFile open_;
    AdviseOnKey advise_;
    bool has_lines_;
    std::optional<std::string> complaint_;
};

/// Returns the element of `possible` that a mistyped word was probably meant to be.
[[nodiscard]] std::optional<std::string_view> nearest(std::string_view word,
                                                      std::span<const std::string_view> possible);

/// Returns "did you mean 'jitter'?" or "use one of delay, jitter, ...".
[[nodiscard]] std::string suggestion(std::string_view word,
                                     std::span<const std::string_view> possible);

/// Reads the entries of a table by their keys, and reports entries that were not read.
class TableReader {
public:
    TableReader(const Node::Table& table, Place place, Reading& reading)
        : table_{table}, place_{place}, reading_{reading}
    {}

    /// Returns the value with this key; nullptr if the table does not have it.
    [[nodiscard]] const Node* find(std::string_view key);
    /// Returns the value with this key. Complains if the table does not have it, and quotes `cure`,
    /// such as `write sd = "10ms"`.
    [[nodiscard]] const Node* require(std::string_view key, std::string_view cure = {});
    /// Complains about keys that were not read. Call it after all keys have been read, even after a
    /// complaint: an unknown key is often the cause of a missing one.
    void finish() const;

    [[nodiscard]] Place place() const { return place_; }
    [[nodiscard]] Reading& reading() const { return reading_; }

private:
    const Node::Table& table_;
    Place place_;
    Reading& reading_;
    std::vector<std::string_view> known_;
    bool is_missing_told_ = false;
};

/// Returns the result of `read(document, reading)` for a whole text, or the first complaint about
/// the text. `source` names the text in complaints.
template <typename Read>
[[nodiscard]] auto parse_text(std::string_view text, const std::string& source, const Read& read)
    -> Result<std::invoke_result_t<const Read&, const Node&, Reading&>>
{
    Reading reading{source};
    const auto document = parse_document(text);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
        return fail(*reading.complaint());
    }
    auto value = read(*document, reading);
    if (!reading.is_good()) return fail(*reading.complaint());
    return value;
}

/// Complains that the value is not what was expected. `expected` is such as "a text in quotes".
void complain_of(const Node& node, std::string_view expected, Reading& reading);

/// Returns the text of a quantity with its unit. A bare 0 needs no unit.
[[nodiscard]] std::optional<std::string_view> quantity(const Node& node);

/// Returns a description of a value's type for a complaint.
[[nodiscard]] std::string what_it_is(const Node& node);

/// Returns a whole number from 0 to `most`; nullopt if the value is anything else.
[[nodiscard]] std::optional<std::uint64_t> count_of(const Node& node, std::uint64_t most);

/// Reads a quantity with its unit. The errors of the parser begin with what to "write".
template <typename Target, typename Parse>
void read_quantity(const Node& node, Target& target, Parse parse, Reading& reading)
{
    const auto text = quantity(node);
    const bool is_number = std::holds_alternative<std::int64_t>(node.value) ||
                           std::holds_alternative<double>(node.value);
    // If the value is neither a text nor a number, the complaint quotes what the parser expects. To
    // the parser, a number without a unit is a wrong text.
    if (!text && !is_number) {
        const auto example = parse("?");
        const std::string message = example.error().message;
        return complain_of(node, message.substr(message.find("write ") + 6), reading);
    }
    const auto value = parse(text ? *text : std::string_view{what_it_is(node)});
    if (!value) return reading.complain(node.place, value.error().message);
    target = static_cast<Target>(*value);
}

// Functions that read the values of keys. A wrong value causes a complaint, and leaves the target
// unchanged.

void read_value(const Node& node, Duration& target, Reading& reading);
void read_value(const Node& node, Probability& target, Reading& reading);
void read_value(const Node& node, double& target, Reading& reading);
void read_value(const Node& node, std::uint8_t& target, Reading& reading);
void read_value(const Node& node, std::uint32_t& target, Reading& reading);
void read_value(const Node& node, std::string& target, Reading& reading);

// Functions that print values as TOML, which reads back as the same value.

[[nodiscard]] std::string quoted(std::string_view text);
/// Returns a text as complaints quote it: 'text', with control characters made visible.
[[nodiscard]] std::string in_quotes(std::string_view text);
[[nodiscard]] std::string value_text(Duration value);
[[nodiscard]] std::string value_text(Probability value);
[[nodiscard]] std::string value_text(double value);
[[nodiscard]] std::string value_text(std::uint8_t value);
[[nodiscard]] std::string value_text(std::uint32_t value);
[[nodiscard]] std::string value_text(const std::string& value);

/// Returns `a, b, c`.
[[nodiscard]] std::string list_text(const std::vector<std::string>& elements);

/// Returns `{ a = 1, b = 2 }`.
[[nodiscard]] std::string table_text(const std::vector<std::string>& entries);

} // namespace hapnet::base
