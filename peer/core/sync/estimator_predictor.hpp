// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/alpha_beta.hpp"
#include "peer/core/sync/base_algorithm.hpp"
#include "peer/core/sync/energy_at_an_omni.hpp"
#include "peer/core/sync/one_way_delay.hpp"

#include <optional>

namespace hapnet::peer {

struct EstimatorPredictorOptions {
    base::Duration time_constant{std::chrono::milliseconds{10}}; // for both filters
    base::Duration force_ahead_max{std::chrono::milliseconds{10}};
    /// The longest prediction of the hand's place, in addition to the median delay.
    base::Duration hip_ahead_beyond_delay{std::chrono::milliseconds{20}};
    /// The age, in addition to the median delay, above which a sample is extrapolated less and
    /// less.
    base::Duration fade_after{std::chrono::milliseconds{10}};
    base::Duration fade_within{std::chrono::milliseconds{50}}; // until nothing is extrapolated
    /// The greatest rate of change of the output. People notice steps of 0.5 N a tick or more.
    double force_slew_n_per_s = 500.0;
    double hip_slew_m_per_s = 5.0;
    /// The gap between two messages above which the filters restart.
    base::Duration gap_max{std::chrono::milliseconds{250}};
    BaseOptions base{};

    friend bool operator==(const EstimatorPredictorOptions&,
                           const EstimatorPredictorOptions&) = default;
};
constexpr auto fields_of(base::Tag<EstimatorPredictorOptions> /*struct*/)
{
    using Options = EstimatorPredictorOptions;
    return base::fields(
        "sep",
        base::field("time_constant", &Options::time_constant, parameter_time, "T, of both filters"),
        base::field("force_ahead_max", &Options::force_ahead_max, parameter_time,
                    "`most` for the force"),
        base::field("hip_ahead_beyond_delay", &Options::hip_ahead_beyond_delay, parameter_time,
                    "`most` for the position is the median delay and this"),
        base::field("fade_after", &Options::fade_after, parameter_time,
                    "age of a sample, beyond the median delay, from which g decreases"),
        base::field("fade_within", &Options::fade_within, parameter_time,
                    "time in which g decreases to 0"),
        base::field("force_slew", &Options::force_slew_n_per_s,
                    base::Quantity{base::force_rate_kind, 0.0, 1e6},
                    "greatest change of the predicted force: half a newton a tick, from which on a "
                    "step counts as one (metric G)"),
        base::field("hip_slew", &Options::hip_slew_m_per_s,
                    base::Quantity{base::speed_kind, 0.0, 1000.0},
                    "greatest speed of the predicted position: faster than a hand"),
        base::field("gap_max", &Options::gap_max, parameter_time,
                    "gap between two messages, by the sender's stamps; after a longer one both "
                    "filters start anew"),
        base::part(&Options::base));
}

/// SEP, the synchronised estimator and predictor: the base algorithm with a prediction of the
/// remote hand's force and position. Alpha-beta filters extrapolate both from their senders' stamps
/// to the present. It stands in for TiDeC, of which no equations are published, and like TiDeC does
/// not change the body's pose.
class EstimatorPredictor {
public:
    /// The energy that the algorithm may bring into a hand at an Omni.
    static constexpr auto energy_limits = energy_at_an_omni(1.1);

    EstimatorPredictor() : EstimatorPredictor(EstimatorPredictorOptions{}) {}
    explicit EstimatorPredictor(const EstimatorPredictorOptions& options);

    void hear(const ReceivedState& received);
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    void forget();

    [[nodiscard]] const EstimatorPredictorOptions& options() const { return options_; }

private:
    /// The time by which the filters' values are extrapolated.
    struct Ahead {
        double force_s = 0.0;
        double hip_s = 0.0;
    };

    [[nodiscard]] Ahead ahead(const Situation& situation) const;
    [[nodiscard]] base::Force force(const Situation& situation, double ahead_s);
    [[nodiscard]] base::Position hip(const Situation& situation, double ahead_s);

    EstimatorPredictorOptions options_;
    BaseAlgorithm base_;
    OneWayDelay delay_;
    AlphaBeta force_;
    AlphaBeta hip_;
    base::Force sample_;      // limited force of the newest sample
    base::TimePoint arrived_; // arrival of the newest sample
    bool touching_ = false;   // the hand touched the body in the newest sample
    bool has_heard_ = false;
    std::optional<base::Force> force_shown_; // predicted force of the last tick
    std::optional<base::Position> hip_shown_;
};

} // namespace hapnet::peer
