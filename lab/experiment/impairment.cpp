// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/impairment.hpp"

#include "proto/base/text.hpp"

#include <chrono>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::experiment {

namespace {

constexpr std::int64_t thousand = 1000;
constexpr std::uint32_t burst_period = 100; // number of messages from one burst to the next
constexpr base::Time level_time{base::Duration{0}, std::chrono::seconds{10}};

base::Duration duration_of(ImpairmentLevel level)
{
    return std::chrono::microseconds{level.thousandths};
}

/// Returns a level as a probability, rounded to 0.001 %. A share with at most three decimals is
/// exact.
base::Probability share_of(ImpairmentLevel level)
{
    const double fraction = static_cast<double>(level.thousandths) / (100.0 * thousand);
    return base::Probability::from_fraction(fraction).value();
}

void read_time_level(const base::Node& node, ImpairmentLevel& target, base::Reading& reading)
{
    base::Duration value{};
    level_time.read(node, value, reading);
    const auto whole = std::chrono::duration_cast<std::chrono::microseconds>(value);
    if (whole != value) return reading.complain(node.place, "a level is in whole microseconds");
    target = {whole.count()};
}

void read_share_level(const base::Node& node, ImpairmentLevel& target, base::Reading& reading)
{
    base::Probability value;
    base::read_value(node, value, reading);
    const double thousandths = value.fraction() * 100.0 * thousand;
    const ImpairmentLevel level{std::llround(thousandths)};
    constexpr double rounding = 1e-12; // error of converting the text to a number
    if (std::abs(share_of(level).fraction() - value.fraction()) > rounding) {
        return reading.complain(node.place, "a level has at most three decimals, such as 92.5%");
    }
    target = level;
}

/// Returns the format of bursts and intervals, which are whole numbers.
base::Count count_format(Impairment impairment)
{
    return {0, impairment == Impairment::interval ? peer::SendPolicy::every_max : burst_period};
}

void read_count_level(const base::Node& node, const base::Count& format, ImpairmentLevel& target,
                      base::Reading& reading)
{
    std::uint32_t count = 0;
    format.read(node, count, reading);
    target = {static_cast<std::int64_t>(count) * thousand};
}

/// Applies an impairment. A loss is added to the present losses. A delay, or a jitter with its
/// mean, replaces the present delay.
void impair(emulator::Conditions& conditions, Impairment impairment, ImpairmentLevel level,
            emulator::Order order)
{
    switch (impairment) {
    case Impairment::delay: conditions.delay = emulator::constant(duration_of(level)); return;
    case Impairment::jitter:
        conditions.delay = emulator::constant(duration_of(level));
        conditions.jitter = emulator::uniform(duration_of(level));
        conditions.order = order;
        return;
    case Impairment::random_loss:
        conditions.loss.push_back(emulator::RandomLoss{share_of(level)});
        return;
    case Impairment::burst_loss:
        conditions.loss.push_back(emulator::Burst{
            static_cast<std::uint32_t>(level.thousandths / thousand), burst_period, {}});
        return;
    case Impairment::interval: return;
    }
}

} // namespace

std::string_view unit_of(Impairment impairment)
{
    constexpr std::array<std::string_view, impairments.size()> units{"ms", "ms", "percent",
                                                                     "of_100", "ticks"};
    return units[static_cast<std::size_t>(impairment)];
}

std::string to_text(ImpairmentLevel level)
{
    std::string text =
        fmt::format("{}.{:03}", level.thousandths / thousand, level.thousandths % thousand);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

double in_units(ImpairmentLevel level) { return static_cast<double>(level.thousandths) / thousand; }

void LevelFormat::read(const base::Node& node, ImpairmentLevel& target,
                       base::Reading& reading) const
{
    switch (impairment) {
    case Impairment::delay:
    case Impairment::jitter: return read_time_level(node, target, reading);
    case Impairment::random_loss: return read_share_level(node, target, reading);
    case Impairment::burst_loss:
    case Impairment::interval:
        return read_count_level(node, count_format(impairment), target, reading);
    }
}

std::string LevelFormat::print(ImpairmentLevel level) const
{
    switch (impairment) {
    case Impairment::delay:
    case Impairment::jitter: return base::value_text(duration_of(level));
    case Impairment::random_loss: return base::quoted(to_text(level) + "%");
    case Impairment::burst_loss:
    case Impairment::interval: return to_text(level);
    }
    return {};
}

std::string LevelFormat::describe() const
{
    switch (impairment) {
    case Impairment::delay:
    case Impairment::jitter: return level_time.describe();
    case Impairment::random_loss: return base::Share{}.describe();
    case Impairment::burst_loss:
    case Impairment::interval: return count_format(impairment).describe();
    }
    return {};
}

emulator::Path impaired(const emulator::Path& ground, Impairment impairment, ImpairmentLevel level,
                        emulator::Order order)
{
    emulator::Path path = ground;
    if (level == ImpairmentLevel{}) return path;
    impair(path.up, impairment, level, order);
    impair(path.down, impairment, level, order);
    return path;
}

peer::SendPolicy thinned(const peer::SendPolicy& send, Impairment impairment, ImpairmentLevel level)
{
    if (impairment != Impairment::interval || level == ImpairmentLevel{}) return send;
    return {.every = static_cast<std::uint32_t>(level.thousandths / thousand), .deadband = {}};
}

} // namespace hapnet::lab::experiment
