// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/netem_words.hpp"

#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

struct Unit {
    std::string_view name;
    double size;
};

// The units of iproute2: lib/utils_math.c and lib/utils.c.
constexpr std::array<Unit, 12> time_units{{
    {"s", 1e9},
    {"sec", 1e9},
    {"secs", 1e9},
    {"ms", 1e6},
    {"msec", 1e6},
    {"msecs", 1e6},
    {"us", 1e3},
    {"usec", 1e3},
    {"usecs", 1e3},
    {"ns", 1.0},
    {"nsec", 1.0},
    {"nsecs", 1.0},
}};
constexpr std::array<Unit, 19> rate_units{{
    {"", 1.0},
    {"bit", 1.0},
    {"kibit", 1024.0},
    {"kbit", 1e3},
    {"mibit", 1048576.0},
    {"mbit", 1e6},
    {"gibit", 1073741824.0},
    {"gbit", 1e9},
    {"tbit", 1e12},
    {"tibit", 1099511627776.0},
    {"bps", 8.0},
    {"kibps", 8192.0},
    {"kbps", 8e3},
    {"mibps", 8388608.0},
    {"mbps", 8e6},
    {"gibps", 8589934592.0},
    {"gbps", 8e9},
    {"tbps", 8e12},
    {"tibps", 8796093022208.0},
}};

struct Quantity {
    double number = 0.0;
    std::string unit; // the unit in lower case
};

std::optional<Quantity> split(std::string_view word)
{
    const auto end = std::min(word.find_first_not_of("0123456789."), word.size());
    Quantity quantity;
    const auto [rest, error] =
        std::from_chars(word.data(), word.data() + end, quantity.number, std::chars_format::fixed);
    if (error != std::errc{} || rest != word.data() + end) return std::nullopt;
    for (const char c : word.substr(end)) {
        quantity.unit += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return quantity;
}

template <std::size_t N>
std::optional<double> in_units(const Quantity& quantity, const std::array<Unit, N>& units)
{
    const auto unit = std::find_if(units.begin(), units.end(),
                                   [&](const Unit& one) { return one.name == quantity.unit; });
    if (unit == units.end()) return std::nullopt;
    return quantity.number * unit->size;
}

} // namespace

NetemWords::NetemWords(std::string_view sentence)
{
    std::string word;
    for (const char c : sentence) {
        const bool is_blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
        if (!is_blank) word += c;
        if (is_blank && !word.empty()) words_.push_back(std::exchange(word, {}));
    }
    if (!word.empty()) words_.push_back(std::move(word));
    const auto netem = std::find(words_.begin(), words_.end(), "netem");
    if (netem != words_.end()) next_ = static_cast<std::size_t>(netem - words_.begin()) + 1;
}

std::string NetemWords::take(std::string_view expected)
{
    if (at_end()) {
        if (!complaint_ && next_ > 0) {
            complaint_ =
                fmt::format("after word {}, '{}': expected {}", next_, words_[next_ - 1], expected);
        }
        return {};
    }
    return words_[next_++];
}

bool NetemWords::take_if(std::string_view word)
{
    if (at_end() || words_[next_] != word) return false;
    ++next_;
    return true;
}

base::Duration NetemWords::time()
{
    constexpr double longest = 1e15; // 10^6 s, as everywhere
    const auto word = take("a time, such as 80ms");
    auto quantity = split(word);
    if (quantity && quantity->unit.empty()) {
        quantity->unit = "us";
        if (quantity->number > 0.0) bare_times_.push_back(word);
    }
    const auto nanoseconds = quantity ? in_units(*quantity, time_units) : std::nullopt;
    if (!nanoseconds || *nanoseconds > longest) {
        complain(fmt::format("'{}' is not a time: write 80ms, for instance", word));
        return {};
    }
    return base::Duration{std::llround(*nanoseconds)};
}

base::Probability NetemWords::share()
{
    auto word = take("a share, such as 1%");
    if (!word.ends_with('%')) word += '%'; // tc reads a number without a unit as per cent
    const auto share = base::parse_probability(word);
    if (!share) complain(share.error().message);
    return share.value_or(base::Probability{});
}

std::uint64_t NetemWords::count(std::uint64_t most)
{
    const auto number = base::parse_count(take("a whole number"), most);
    if (!number) complain(number.error().message);
    return number.value_or(0);
}

std::uint64_t NetemWords::bits_per_second()
{
    constexpr double fastest = 1e12;
    const auto word = take("a rate, such as 10mbit");
    const auto quantity = split(word);
    const auto bits = quantity ? in_units(*quantity, rate_units) : std::nullopt;
    if (!bits || *bits > fastest || *bits < 1.0) {
        complain(fmt::format("'{}' is not a rate: write 10mbit, for instance", word));
        return 0;
    }
    return static_cast<std::uint64_t>(std::llround(*bits));
}

std::optional<base::Duration> NetemWords::optional_time()
{
    return is_time_next() ? std::optional{time()} : std::nullopt;
}

std::optional<base::Probability> NetemWords::optional_share()
{
    return is_number_next() ? std::optional{share()} : std::nullopt;
}

std::optional<std::int64_t> NetemWords::optional_integer()
{
    if (!is_number_next()) return std::nullopt;
    const auto word = take("a whole number");
    std::int64_t value = 0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || rest != word.data() + word.size()) {
        complain(fmt::format("'{}' is not a whole number", word));
    }
    return value;
}

void NetemWords::complain(const std::string& what)
{
    if (!complaint_) complaint_ = fmt::format("word {}: {}", next_, what);
}

bool NetemWords::is_number_next() const
{
    if (at_end() || complaint_) return false;
    const std::string& word = words_[next_];
    const char first = word.starts_with('-') && word.size() > 1 ? word[1] : word[0];
    return (first >= '0' && first <= '9') || first == '.';
}

bool NetemWords::is_time_next() const { return is_number_next() && !words_[next_].ends_with('%'); }

} // namespace hapnet::emulator::tools
