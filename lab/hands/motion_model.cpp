// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/motion_model.hpp"

#include "device/simulated/minimum_jerk.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "proto/base/normal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace hapnet::lab::hands {

namespace {

constexpr double m_per_mm = 1e-3;
constexpr double log_of_octave = 0.69314718055994530942; // ln 2
constexpr double movement_log_sd = 0.3; // of the times of movements; chosen, not fitted

double normal_of(const base::RandomStream& stream, std::uint64_t index, std::uint32_t draw = 0)
{
    constexpr double least = 1e-12; // 7 standard deviations
    return base::normal_quantile(std::clamp(stream.uniform(index, draw), least, 1.0 - least));
}

glm::dvec3 spread_of(const MotionModel& model)
{
    return m_per_mm * glm::dvec3{model.target_x_mm, model.target_y_mm, model.target_z_mm};
}

/// Adds the movements from target to target. The first one may have begun before the motion.
void add_movements(Places& places, const MotionModel& model, double rate_hz, base::Seed seed)
{
    const auto targets = seed.stream("hands/targets");
    const auto times = seed.stream("hands/movements");
    const auto rests = seed.stream("hands/rests");
    const auto target = [&](std::uint64_t index) {
        return spread_of(model) * glm::dvec3{normal_of(targets, index, 0),
                                             normal_of(targets, index, 1),
                                             normal_of(targets, index, 2)};
    };
    glm::dvec3 from = target(0);
    double begin_s = -rests.uniform(0) * (model.movement_s + model.rest_s);
    std::size_t i = 0;
    for (std::uint64_t movement = 1; i < places.size(); ++movement) {
        const glm::dvec3 to = target(movement);
        const double length_s =
            model.movement_s * base::exp(movement_log_sd * normal_of(times, movement));
        const double rest_s = -model.rest_s * base::log1p(-rests.uniform(movement));
        for (; i < places.size(); ++i) {
            const double passed_s = static_cast<double>(i) / rate_hz - begin_s;
            if (passed_s >= length_s + rest_s) break;
            places[i] += from + (to - from) * device::minimum_jerk(passed_s / length_s);
        }
        from = to;
        begin_s += length_s + rest_s;
    }
}

void add_unrest(Places& places, const MotionModel& model, double rate_hz, base::Seed seed)
{
    constexpr std::uint32_t sines = 4;
    const auto stream = seed.stream("hands/unrest");
    const glm::dvec3 spread = spread_of(model);
    const double all = glm::length(spread);
    if (all == 0.0) return;
    std::vector<double> values(places.size());
    for (const int axis : {0, 1, 2}) {
        const double speed = m_per_mm * model.unrest_mm_s * spread[axis] / all;
        for (std::uint32_t sine = 0; sine < sines; ++sine) {
            const auto index = static_cast<std::uint64_t>(axis) * sines + sine;
            const double hertz =
                model.unrest_hz * base::exp(log_of_octave * (2.0 * stream.uniform(index, 0) - 1.0));
            const double phase = stream.uniform(index, 1); // turns
            for (std::size_t i = 0; i < values.size(); ++i)
                values[i] = phase + hertz / rate_hz * static_cast<double>(i);
            base::sines_of_turns(values);
            // A sine of the velocity with the root mean square 1/sqrt(sines) of all.
            const double amplitude = speed * std::sqrt(2.0 / sines) / (base::two_pi * hertz);
            for (std::size_t i = 0; i < values.size(); ++i)
                places[i][axis] += amplitude * values[i];
        }
    }
}

constexpr double least_length_mm = 0.1; // added to spreads before their logarithm

/// The figures as they are compared.
using Score = std::array<double, 9>;

Score score_of(const Places& places)
{
    const MotionFigures figures = figures_of(places);
    // Added before the logarithm, so that what hardly moves compares as equal.
    constexpr double speed_mm_s = 1.0, frequency_hz = 0.05, per_s = 0.3;
    constexpr double rest_weight = 2.0; // a difference of half the time counts like a factor of e
    return {base::log(figures.spread_x_mm + least_length_mm),
            base::log(figures.spread_y_mm + least_length_mm),
            base::log(figures.spread_z_mm + least_length_mm),
            base::log(figures.speed_mm_s + speed_mm_s),
            base::log(figures.speed_max_mm_s + speed_mm_s),
            base::log(figures.half_power_hz + frequency_hz),
            base::log(figures.most_power_hz + frequency_hz),
            base::log(figures.peaks_per_s + per_s),
            rest_weight * figures.rest_share};
}

/// The figures of recorded motions: mean and standard deviation.
struct Goal {
    Score mean{};
    Score sd{};
    std::vector<std::size_t> lengths; // of the motions
};

Goal goal_of(std::span<const Places> recorded)
{
    constexpr double sd_min = 0.1;        // a tenth of a figure, and what a single motion has
    constexpr std::size_t longest = 1500; // 30 s: longer motions are cut
    Goal goal;
    std::vector<Score> scores;
    for (const Places& places : recorded) {
        const std::size_t parts = 1 + (places.size() - 1) / longest;
        for (std::size_t part = 0; part < parts; ++part) {
            const auto at = [&](std::size_t i) {
                return places.begin() + static_cast<std::ptrdiff_t>(places.size() * i / parts);
            };
            scores.push_back(score_of({at(part), at(part + 1)}));
            goal.lengths.push_back(static_cast<std::size_t>(at(part + 1) - at(part)));
        }
    }
    const auto count = static_cast<double>(scores.size());
    for (std::size_t k = 0; k < goal.mean.size(); ++k) {
        double squares = 0.0;
        for (const Score& score : scores) goal.mean.at(k) += score.at(k) / count;
        for (const Score& score : scores) {
            const double off = score.at(k) - goal.mean.at(k);
            squares += off * off / std::max(count - 1.0, 1.0);
        }
        goal.sd.at(k) = std::max(std::sqrt(squares), sd_min);
    }
    return goal;
}

/// Returns how far the figures of simulated motions are from the goal. It draws the same numbers
/// for every model.
double cost_of(const MotionModel& model, const Goal& goal)
{
    constexpr std::size_t motions = 24;
    Score mean{};
    for (std::size_t i = 0; i < motions; ++i) {
        // Their lengths are spread over those of the recorded motions.
        const std::size_t count = goal.lengths.size();
        const std::size_t length = goal.lengths[count > motions ? i * count / motions : i % count];
        const Score score = score_of(simulated(model, length, figures_rate_hz, base::Seed{i + 1}));
        for (std::size_t k = 0; k < mean.size(); ++k)
            mean.at(k) += score.at(k) / static_cast<double>(motions);
    }
    double cost = 0.0;
    for (std::size_t k = 0; k < mean.size(); ++k) {
        const double off = (mean.at(k) - goal.mean.at(k)) / goal.sd.at(k);
        cost += off * off;
    }
    return cost;
}

/// A parameter of the model, with the range in which it is searched.
struct Parameter {
    double MotionModel::*value;
    double least;
    double most;
};
// The unrest reaches to twice its middle frequency, and recordings are smoothed at 6 Hz.
constexpr std::array fitted_parameters{Parameter{&MotionModel::target_x_mm, 0.01, 1000.0},
                                       Parameter{&MotionModel::target_y_mm, 0.01, 1000.0},
                                       Parameter{&MotionModel::target_z_mm, 0.01, 1000.0},
                                       Parameter{&MotionModel::movement_s, 0.1, 5.0},
                                       Parameter{&MotionModel::rest_s, 0.01, 5.0},
                                       Parameter{&MotionModel::unrest_mm_s, 0.1, 1000.0},
                                       Parameter{&MotionModel::unrest_hz, 0.5, 4.0}};

struct Candidate {
    MotionModel model;
    double cost = 0.0;
};

/// Searches from a start along one parameter after another, with steps that are halved.
Candidate searched(const MotionModel& start, const Goal& goal)
{
    constexpr double step_first = 0.4, step_last = 0.04; // of the logarithm of a parameter
    constexpr double enough = 0.999;                     // a smaller gain is none
    constexpr int sweeps_max = 60;
    Candidate best{start, cost_of(start, goal)};
    int sweeps = 0;
    for (double step = step_first; step > step_last && sweeps < sweeps_max; ++sweeps) {
        bool is_better = false;
        for (const Parameter& parameter : fitted_parameters) {
            for (const double factor : {base::exp(step), base::exp(-step)}) {
                MotionModel other = best.model;
                other.*parameter.value =
                    std::clamp(other.*parameter.value * factor, parameter.least, parameter.most);
                const double cost = cost_of(other, goal);
                if (!(cost < enough * best.cost)) continue;
                best = {other, cost};
                is_better = true;
                break;
            }
        }
        if (!is_better) step *= 0.5;
    }
    return best;
}

} // namespace

std::vector<glm::dvec3> simulated(const MotionModel& model, std::size_t count, double rate_hz,
                                  base::Seed seed)
{
    Places places(count, glm::dvec3{0.0});
    add_movements(places, model, rate_hz, seed);
    add_unrest(places, model, rate_hz, seed);
    return places;
}

MotionModel fitted_model(std::span<const Places> recorded)
{
    base::ensure(!recorded.empty());
    const Goal goal = goal_of(recorded);
    MotionModel first;
    for (std::size_t k = 0; k < 3; ++k) {
        const Parameter& target = fitted_parameters.at(k);
        first.*target.value =
            std::clamp(base::exp(goal.mean.at(k)) - least_length_mm, target.least, target.most);
    }
    first.unrest_mm_s = 0.3 * base::exp(goal.mean[3]);
    std::optional<Candidate> best;
    for (const double movement_s : {0.4, 1.2}) {
        for (const double rest_s : {0.1, 0.6}) {
            MotionModel start = first;
            start.movement_s = movement_s;
            start.rest_s = rest_s;
            const Candidate found = searched(start, goal);
            if (!best || found.cost < best->cost) best = found;
        }
    }
    return best->model;
}

} // namespace hapnet::lab::hands
