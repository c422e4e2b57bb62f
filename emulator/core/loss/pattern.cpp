// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/pattern.hpp"

#include "proto/base/ensure.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

base::Result<void> PatternLoss::validate() const
{
    if (!pattern.empty()) return {};
    return base::fail("the pattern is empty: write 0 (passes) and 1 (lost), such as \"0010\"");
}

LossTheory PatternLoss::theory(const Arrivals& /*arrivals*/) const
{
    return theory_of_period(pattern.size(), [&](std::size_t i) { return bool{pattern[i]}; });
}

std::vector<LossProperty> PatternLoss::properties(const RunFacts& facts) const
{
    return {same_losses(*this, facts.count)};
}

void PatternLoss::Model::change(const PatternLoss& law, const base::RandomStream& /*stream*/)
{
    base::ensure(!law.pattern.empty());
    if (law != law_) law_ = law;
}

base::Result<std::vector<bool>> parse_pattern(std::string_view text)
{
    constexpr std::size_t digits_max = 1'000'000;
    if (text.empty() || text.find_first_not_of("01") != std::string_view::npos) {
        return base::fail(
            "a pattern is written as 0 (passes) and 1 (lost), such as \"0010\" for every fourth");
    }
    if (text.size() > digits_max) {
        return base::fail(fmt::format("a pattern has at most {} digits", digits_max));
    }
    std::vector<bool> pattern;
    for (const char c : text) pattern.push_back(c == '1');
    return pattern;
}

void PatternDigits::read(const base::Node& node, std::vector<bool>& target,
                         base::Reading& reading) const
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr) return complain_of(node, describe(), reading);
    auto pattern = parse_pattern(*text);
    if (!pattern) return reading.complain(node.place, pattern.error().message);
    target = *std::move(pattern);
}

std::string to_text(const std::vector<bool>& pattern)
{
    std::string text;
    for (const bool is_lost : pattern) text += is_lost ? '1' : '0';
    return text;
}

} // namespace hapnet::emulator
