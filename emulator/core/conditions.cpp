// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/conditions.hpp"

#include "proto/base/text.hpp"

#include <limits>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <vector>

namespace hapnet::emulator {

std::string_view to_text(Direction direction) { return direction == Direction::up ? "up" : "down"; }

std::string_view to_text(Order order) { return order == Order::keep ? "keep" : "free"; }

base::Result<Order> parse_order(std::string_view text)
{
    for (const Order order : {Order::keep, Order::free}) {
        if (text == to_text(order)) return order;
    }
    return base::fail(fmt::format("'{}' is not an order: write keep or free", text));
}

base::Result<std::optional<Burst>> parse_burst(std::string_view text)
{
    if (text == "0") return std::nullopt;
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    const auto slash = text.find('/');
    if (slash != std::string_view::npos) {
        const auto lost = base::parse_count(text.substr(0, slash), most);
        const auto of = base::parse_count(text.substr(slash + 1), most);
        if (lost && of && 0 < *lost && *lost <= *of) {
            return Burst{static_cast<std::uint32_t>(*lost), static_cast<std::uint32_t>(*of)};
        }
    }
    return base::fail(fmt::format("'{}' is not a burst: write LOST/OF, such as 40/100 for 40 in a "
                                  "row of every 100",
                                  text));
}

std::string to_text(const Burst& burst) { return fmt::format("{}/{}", burst.lost, burst.of); }

Pipeline pipeline_of(const Conditions& conditions, base::Seed seed, Direction direction)
{
    const auto stream = [&](std::string_view stage) {
        return seed.stream(fmt::format("{}/{}", to_text(direction), stage));
    };
    std::vector<Impairment> stages;
    if (conditions.loss.fraction() > 0) {
        stages.emplace_back(RandomLoss{conditions.loss, stream("random-loss")});
    }
    if (conditions.burst_loss) {
        stages.emplace_back(BurstLoss{*conditions.burst_loss, stream("burst-loss")});
    }
    if (conditions.delay > base::Duration{0}) {
        stages.emplace_back(ConstantDelay{conditions.delay});
    }
    if (conditions.jitter > base::Duration{0}) {
        stages.emplace_back(UniformJitter{conditions.jitter, stream("jitter")});
    }
    return Pipeline{std::move(stages)};
}

} // namespace hapnet::emulator
