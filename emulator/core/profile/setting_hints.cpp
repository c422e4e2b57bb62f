// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/setting_hints.hpp"

#include "emulator/core/conditions.hpp"
#include "emulator/core/profile/settings.hpp"
#include "proto/base/fields.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::emulator {

namespace {

/// An example of a law's notation. `setting` is "loss", or "delay" for delay and jitter.
struct LawExample {
    std::string_view setting;
    std::string_view law;
    std::string_view text;
};

constexpr std::string_view gilbert_elliott =
    R"({ law = "gilbert-elliott", good_to_bad = "1%", bad_to_good = "25%" })";
constexpr std::string_view normal = R"({ law = "normal", sd = "5ms" })";

constexpr std::array examples{
    LawExample{"loss", "random", R"({ law = "random", share = "2%" })"},
    LawExample{"loss", "k-of-n", R"({ law = "k-of-n", lost = 5, of = 100 })"},
    LawExample{"loss", "every", R"({ law = "every", every = 100 })"},
    LawExample{"loss", "burst", R"({ law = "burst", lost = 40, of = 100 })"},
    LawExample{"loss", "timed-burst", R"({ law = "timed-burst", lost = "50ms", every = "1s" })"},
    LawExample{"loss", "gilbert", R"({ law = "gilbert", share = "2%", mean_burst = 5.0 })"},
    LawExample{"loss", "gilbert-elliott", gilbert_elliott},
    LawExample{"loss", "gemodel", gilbert_elliott}, // the name in tc-netem
    LawExample{"loss", "timed-gilbert-elliott",
               R"({ law = "timed-gilbert-elliott", mean_good = "10s", mean_bad = "200ms" })"},
    LawExample{
        "loss", "four-state",
        R"({ law = "four-state", share = "2%", burst = 8.0, density = "80%", isolated = "0.1%" })"},
    LawExample{"loss", "list", R"({ law = "list", numbers = [3, 17] })"},
    LawExample{"loss", "pattern", R"({ law = "pattern", pattern = "0001" })"},
    LawExample{"loss", "trace", R"({ law = "trace", file = "losses.csv" })"},
    LawExample{"loss", "timed-trace", R"({ law = "timed-trace", file = "losses.csv" })"},
    LawExample{"loss", "outage", R"({ law = "outage", windows = [["10s", "12s"]] })"},
    LawExample{"delay", "constant", R"({ law = "constant", value = "80ms" })"},
    LawExample{"delay", "uniform", R"({ law = "uniform", half_width = "5ms" })"},
    LawExample{"delay", "normal", normal},
    LawExample{"delay", "gaussian", normal},
    LawExample{"delay", "log-normal", R"({ law = "log-normal", mean = "10ms", sd = "5ms" })"},
    LawExample{"delay", "exponential", R"({ law = "exponential", mean = "5ms" })"},
    LawExample{"delay", "pareto", R"({ law = "pareto", mean = "5ms" })"},
    LawExample{"delay", "gamma", R"({ law = "gamma", mean = "10ms", sd = "5ms" })"},
    LawExample{"delay", "table",
               R"({ law = "table", file = "table.txt", mean = "10ms", sd = "5ms" })"},
    LawExample{"delay", "trace", R"({ law = "trace", file = "delays.csv" })"},
};

/// Returns the fields of all laws of a variant.
template <typename Law>
std::vector<const base::FieldTable*> law_tables()
{
    return []<typename... Laws>(const std::variant<Laws...>*) {
        return std::vector<const base::FieldTable*>{&base::field_table<Laws>()...};
    }(static_cast<const Law*>(nullptr));
}

struct PlaceOfKeys {
    std::vector<std::string_view> keys;
    std::string where;
};

/// Returns the keys of a profile, by the tables that have them. The keys of laws are in their
/// descriptions.
std::vector<PlaceOfKeys> places_of_keys()
{
    return {{{setting_keys.begin(), setting_keys.end()},
             "write it below [both], [up] or [down]; below [[at]] it needs a direction: up.delay"},
            {{"name", "seed"}, "write it at the top, above the first [table]"},
            {{"both", "all", "up", "down"}, "write it as a table of its own: [both]"},
            {{"time", "ramp"}, "it belongs to a change: write it below [[at]]"},
            {{"require"}, "it belongs to a check: write it below [[check]]"},
            {{"peers"}, "write it below [matrix]"},
            {{"match", "pass"}, "it belongs to a flow: write it below [[flow]]"},
            {{"stay", "to"}, "it belongs to a regime: write it below [[up.regime]]"},
            {{"flow"}, "write flows as [[flow]], at the top level"}};
}

/// Returns the first example that matches a word of the value.
std::string_view example_for(std::string_view name, std::string_view value)
{
    while (!value.empty()) {
        const auto end = std::min(value.find(' '), value.size());
        if (const auto example = law_example(name, value.substr(0, end)); !example.empty()) {
            return example;
        }
        value.remove_prefix(std::min(end + 1, value.size()));
    }
    return "";
}

/// True if a value of several words is in the notation of tc-netem: "80ms 10ms distribution
/// normal".
bool is_netem(std::string_view value)
{
    constexpr std::array<std::string_view, 12> words{
        "distribution", "normal", "pareto",  "paretonormal", "uniform", "experimental",
        "random",       "state",  "gemodel", "gap",          "ecn",     "loss"};
    std::size_t count = 0;
    while (!value.empty()) {
        const auto end = std::min(value.find(' '), value.size());
        const auto word = value.substr(0, end);
        value.remove_prefix(std::min(end + 1, value.size()));
        if (word.empty()) continue;
        const bool is_number = word[0] >= '0' && word[0] <= '9';
        const bool is_word = std::find(words.begin(), words.end(), word) != words.end();
        if (++count > 1 && !is_number && !is_word) return false;
    }
    return count > 1;
}

} // namespace

std::string_view law_example(std::string_view name, std::string_view law)
{
    const std::string_view setting = name == "jitter" ? "delay" : name;
    for (const LawExample& example : examples) {
        if (example.setting == setting && example.law == law) return example.text;
    }
    return "";
}

std::string advice_on_key(std::string_view key)
{
    std::string plain{key};
    std::replace(plain.begin(), plain.end(), '-', '_');
    for (const auto& [keys, where] : places_of_keys()) {
        if (std::find(keys.begin(), keys.end(), plain) != keys.end()) return where;
    }
    for (const auto& [setting, laws] :
         {std::pair{"loss", law_tables<LossLaw>()}, std::pair{"jitter", law_tables<DelayLaw>()}}) {
        for (const base::FieldTable* law : laws) {
            const auto example = law_example(setting, law->name);
            const auto has_key = [&](const base::FieldRow& row) { return row.key == plain; };
            if (example.empty() || !std::any_of(law->rows.begin(), law->rows.end(), has_key))
                continue;
            return fmt::format("it belongs to a law: {} = {}", setting, example);
        }
    }
    return "";
}

std::string with_unit(std::string_view name, std::string_view value)
{
    const bool is_number =
        !value.empty() && value.find_first_not_of("0123456789") == std::string_view::npos;
    return fmt::format("{}{}", value, name == "mtu" && is_number ? "B" : "");
}

std::string explained(std::string_view name, const std::string& value, const std::string& why)
{
    if (value.starts_with('{') || value.starts_with('[')) {
        return fmt::format("'{}': {}", value, why);
    }
    if (name == "reorder" && base::parse_probability(value)) {
        return fmt::format("'{0}': give displacement, too, the number of later datagrams: "
                           "'{{ share = \"{0}\", displacement = 3 }}'",
                           value);
    }
    if (const auto example = example_for(name, value); !example.empty()) {
        return fmt::format("'{}': a law is written as a table: '{}'", value, example);
    }
    const bool is_of_netem = name == "delay" || name == "loss" || name == "duplicate" ||
                             name == "corrupt" || name == "reorder";
    const bool has_space = why.find(" has a space: ") != std::string::npos; // before the unit
    if (is_of_netem && !has_space && is_netem(value)) {
        return fmt::format("'{0}': a sentence of tc-netem goes to hapnet-emulator --netem "
                           "\"{1} {0}\"",
                           value, name);
    }
    if (why.find(value) != std::string::npos) return why;
    return fmt::format("'{}': {}", value, why);
}

} // namespace hapnet::emulator
