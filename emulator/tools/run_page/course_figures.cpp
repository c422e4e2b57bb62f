// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/theory.hpp"
#include "emulator/core/loss/loss.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/settings.hpp"
#include "emulator/core/regime_chain.hpp"
#include "emulator/tools/run_page/figures.hpp"
#include "proto/page/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::emulator::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t marks_max = 40; // more lines across a figure are not readable
/// Conditions at the start that last for less than this time are not drawn: the run begins with the
/// next ones.
constexpr double shortest_start_s = 1e-3;

/// The conditions after a change.
struct Knot {
    double at_s = 0.0;
    Path path;
    bool ends_ramp = false; // a straight line leads here from the previous knot
};

base::Result<std::string> no_files(std::string_view name)
{
    return base::fail(fmt::format("{} is not read again", name));
}

/// Returns the path after a change in the statistics. The error says which setting cannot be read
/// again.
base::Result<Path> changed(const Path& before, const Json& settings)
{
    std::vector<Setting> read;
    for (const auto& [key, value] : settings.items()) {
        const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
        PathNames names{.any = true};
        const std::string_view way{key.data(), std::min(key.rfind('.'), key.size())};
        if (const auto of = parse_way(way)) names.flows.emplace_back(parts_of(of->path).flow);
        auto setting = parse_setting(key, text, no_files, names);
        if (!setting) return tl::unexpected{setting.error()};
        setting->path.clear(); // statistics of one path have only its own settings
        read.push_back(*std::move(setting));
    }
    return with_settings(before, read);
}

base::Result<std::vector<Knot>> knots_of(const Path& start, const Json& statistics)
{
    std::vector<Knot> knots{{0.0, start, false}};
    const Json changes = statistics.value("changes", Json::array());
    for (std::size_t i = 0; i < changes.size(); ++i) {
        const Json& change = changes[i];
        auto path = changed(knots.back().path, change.value("settings", Json::object()));
        if (!path) return tl::unexpected{path.error()};
        const bool is_end = i > 0 && ends_ramp(changes[i - 1], change);
        const double at_s = change.value("elapsed_s", 0.0);
        if (at_s < shortest_start_s) {
            knots = {{0.0, *std::move(path), false}};
        } else {
            knots.push_back({at_s, *std::move(path), is_end});
        }
    }
    return knots;
}

/// Returns the mean of a value over the regimes, by their shares; without regimes the value itself.
double over_regimes(const Conditions& conditions,
                    const std::function<double(const Conditions&)>& value)
{
    const auto& all = conditions.regimes.all.get();
    if (all.empty()) return value(conditions);
    const auto shares = shares_of(all);
    double mean = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        mean += shares[i] * value(in_regime(conditions, i));
    }
    return mean;
}

double delay_ms(const Conditions& conditions)
{
    const auto mean =
        DelayTheory{conditions.delay.law}.mean() + DelayTheory{conditions.jitter.law}.mean();
    return 1e3 * base::to_seconds(std::max(mean, base::Duration{0}));
}

/// Returns the rate in Mbit/s; not a number where there is no fixed limit.
double rate_mbits(const Conditions& conditions)
{
    if (conditions.rate.bits_per_second == 0) return not_known;
    return 1e-6 * static_cast<double>(conditions.rate.bits_per_second);
}

/// Returns the share that all laws together lose, in percent.
double loss_percent(const Conditions& conditions, const Arrivals& arrivals)
{
    double passing = 1.0;
    for (const LossLaw& law : conditions.loss) passing *= 1.0 - theory_of(law, arrivals).share;
    return 100.0 * (1.0 - passing);
}

std::vector<page::Point> points_of(const std::vector<Knot>& knots, double end_s,
                                   const std::function<double(const Path&)>& value)
{
    std::vector<page::Point> points;
    for (const Knot& knot : knots) {
        if (!points.empty() && !knot.ends_ramp) points.push_back({knot.at_s, points.back().y});
        points.push_back({knot.at_s, value(knot.path)});
    }
    points.push_back({std::max(end_s, points.back().x), points.back().y});
    return points;
}

/// A stretch of the statistics, with the part of it that the run lasted.
struct Measured {
    const Json& json;
    double length_s = 0.0;

    [[nodiscard]] double number(const char* pointer) const
    {
        const Json::json_pointer at{pointer};
        if (!json.contains(at) || !json[at].is_number()) return not_known;
        return json[at].get<double>();
    }
};

/// A kind of figure over time: the requested and the measured values.
struct Kind {
    std::string_view name;
    page::Axis y;
    std::function<double(const Conditions&)> asked; // empty: it cannot be requested
    std::function<double(const Measured&)> measured;
    std::function<page::Range(const Measured&)> spread; // empty: no band is drawn
    std::string about;
};

/// The data of one figure.
struct Course {
    std::vector<Knot> knots; // empty: the conditions cannot be read
    double asked_until_s = 0.0;
    double length_s = 0.0;
    const Json& statistics;

    [[nodiscard]] page::Curve asked(const Kind& kind, Direction direction) const
    {
        page::Curve curve;
        curve.points = points_of(knots, asked_until_s, [&](const Path& path) {
            return over_regimes(direction == Direction::up ? path.up : path.down, kind.asked);
        });
        curve.width = 2.0;
        curve.is_dashed = true;
        return curve;
    }

    [[nodiscard]] page::Curve measured(const Kind& kind, Direction direction) const
    {
        page::Curve curve;
        const Json::json_pointer at{fmt::format("/{}/lens/over_time", to_text(direction))};
        if (!statistics.contains(at)) return curve;
        for (const Json& stretch : statistics[at]) {
            const double from_s = stretch.value("from_s", 0.0);
            const double lasted_s = std::min(stretch.value("length_s", 0.0), length_s - from_s);
            if (lasted_s <= 0.0) continue;
            const Measured one{stretch, lasted_s};
            const double x = from_s + lasted_s / 2;
            curve.points.push_back({x, kind.measured(one)});
            if (kind.spread) curve.band.push_back({x, kind.spread(one)});
        }
        return curve;
    }
};

/// Returns the figure; nullopt if no value is above zero.
std::optional<page::Figure> figure_of(const Kind& kind, const Course& course)
{
    std::vector<page::Curve> curves;
    for (const Direction direction : {Direction::up, Direction::down}) {
        const auto add = [&](page::Curve curve, const char* what) {
            curve.name = fmt::format("{}, {}", words_on(direction), what);
            curve.colour = direction == Direction::up ? "left" : "right";
            std::ranges::move(page::parts_of(curve), std::back_inserter(curves));
        };
        if (kind.asked && !course.knots.empty()) add(course.asked(kind, direction), "asked");
        add(course.measured(kind, direction), "measured");
    }
    const bool is_used = std::ranges::any_of(curves, [](const page::Curve& curve) {
        return std::ranges::any_of(curve.points, [](const page::Point& p) { return p.y > 0.0; });
    });
    if (!is_used) return std::nullopt;
    page::Curves content{std::move(curves)};
    if (course.knots.size() <= marks_max) {
        for (const Knot& knot : course.knots)
            if (knot.at_s > 0.0) content.moments.push_back(knot.at_s);
    }
    return page::Figure{
        .id = fmt::format("{}-over-time", kind.name),
        .title = fmt::format("{} over time", kind.y.label),
        .x = {"time since the emulator started", "s", page::Scale::linear, {0.0, course.length_s}},
        .y = kind.y,
        .content = std::move(content),
        .size = {520.0, 240.0},
        .caption = kind.about};
}

/// Returns the mean time between two arrivals, and their number.
Arrivals arrivals_of(const Json& statistics, double length_s)
{
    const auto received =
        statistics.value("up", Json::object()).value("received", std::uint64_t{0});
    const bool is_known = received > 0 && length_s > 0.0;
    return {base::from_seconds(is_known ? length_s / static_cast<double>(received) : 1e-3),
            std::max<std::uint64_t>(received, 1)};
}

page::Axis axis_of(const char* label, const char* unit)
{
    return {label, unit, page::Scale::linear, page::Range{0.0, 0.0}};
}

std::vector<Kind> kinds_for(const Arrivals& arrivals)
{
    return {
        {.name = "delay",
         .y = axis_of("Delay", "ms"),
         .asked = delay_ms,
         .measured = [](const Measured& one) { return one.number("/delay_ms/mean"); },
         .spread =
             [](const Measured& one) {
                 return page::Range{one.number("/delay_ms/min"), one.number("/delay_ms/max")};
             },
         .about = "Asked: the mean of the laws of delay and jitter. Measured: the mean, with all "
                  "delays of a stretch as a band."},
        {.name = "loss",
         .y = axis_of("Loss", "%"),
         .asked = [=](const Conditions& one) { return loss_percent(one, arrivals); },
         .measured =
             [](const Measured& one) {
                 return 100.0 * one.number("/dropped") / one.number("/received");
             },
         .spread = {},
         .about = "Asked: the share of all datagrams that the laws of loss take. Measured: drops "
                  "by any cause, per arrival."},
        {.name = "rate",
         .y = axis_of("Rate", "Mbit/s"),
         .asked = rate_mbits,
         .measured =
             [](const Measured& one) { return 8e-6 * one.number("/bytes_out") / one.length_s; },
         .spread = {},
         .about = "Asked: the limit, where there is one that follows no trace. Measured: the "
                  "payload that left."},
        {.name = "queue",
         .y = axis_of("Time in the queue", "ms"),
         .asked = {},
         .measured = [](const Measured& one) { return one.number("/queue_max_ms"); },
         .spread = {},
         .about = "The longest wait before the line of the rate."},
    };
}

} // namespace

bool ends_ramp(const Json& before, const Json& change)
{
    return change.value("generation", 0) > before.value("generation", 0) + 1;
}

CourseFigures course_figures(const Path& start, const Json& statistics)
{
    CourseFigures found;
    const double length_s = statistics.value("duration_s", 0.0);
    Course course{
        .knots = {}, .asked_until_s = length_s, .length_s = length_s, .statistics = statistics};
    std::string about_asked = " A vertical line is a change.";
    const std::string_view about_band =
        " A band that spans one has the delays of both sides of it: "
        "that is no jitter.";
    if (auto knots = knots_of(start, statistics)) {
        course.knots = *std::move(knots);
    } else {
        found.why_not_asked = knots.error().message;
    }
    if (const auto omitted = statistics.value("changes_omitted", std::uint64_t{0});
        omitted > 0 && !course.knots.empty()) {
        course.asked_until_s = course.knots.back().at_s;
        about_asked += fmt::format(" What was asked for ends where the list of changes is full: {} "
                                   "later changes are not in it.",
                                   omitted);
    }
    for (Kind& kind : kinds_for(arrivals_of(statistics, length_s))) {
        if (course.knots.size() > 1) kind.about += about_asked;
        if (course.knots.size() > 1 && kind.spread) kind.about += about_band;
        if (auto figure = figure_of(kind, course)) found.figures.push_back(*std::move(figure));
    }
    return found;
}

} // namespace hapnet::emulator::tools
