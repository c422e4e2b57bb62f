// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <optional>

namespace hapnet::emulator {

// Chains of two states (Gilbert 1960, Elliott 1963).
//
//                     good_to_bad
//              +---------------------->+
//              |                       |
//   1 - g2b +------+               +-------+ 1 - b2g
//      +--->| good |               |  bad  |<---+
//      +----|      |               |       |----+
//           +------+               +-------+
//              |                       |
//              +<----------------------+
//                     bad_to_good
//
// A datagram is lost with the probability loss_good in the good state and loss_bad in the bad one.
// Rules of thumb: good_to_bad = 1 % means about 100 datagrams in good before the state turns bad;
// bad_to_good = 20 % means about 5 in bad, so that with loss_bad = 100 % bursts have a mean of 5.
// The share of time in bad is good_to_bad / (good_to_bad + bad_to_good): here 1 / 21 = 4.8 %.
//
// The first state is drawn from the stationary law, so that short runs lose their share on average
// as well (tc-netem starts in the good state). A change of the numbers keeps the state.

/// The probabilities of a chain of two states, per datagram. A datagram is judged before the step.
struct TwoStateSteps {
    double good_to_bad = 0.0;
    double bad_to_good = 0.0;
    double loss_good = 0.0;
    double loss_bad = 0.0;

    /// Returns the share of datagrams that are judged in the bad state. A chain that never moves is
    /// good.
    [[nodiscard]] double bad_share() const
    {
        const double moves = good_to_bad + bad_to_good;
        return moves > 0.0 ? good_to_bad / moves : 0.0;
    }
};

/// A running chain of two states, one step per datagram: the model of each law that has steps().
class TwoStateChain {
public:
    TwoStateChain(const TwoStateSteps& steps, const base::RandomStream& stream);
    template <typename Law>
    TwoStateChain(const Law& law, const base::RandomStream& stream)
        : TwoStateChain{law.steps(), stream}
    {}

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream& stream);
    template <typename Law>
    void change(const Law& law, const base::RandomStream& /*stream*/)
    {
        steps_ = law.steps();
    }

    /// Returns the state in which the last datagram was judged.
    [[nodiscard]] LossState state() const { return state_; }

private:
    TwoStateSteps steps_;
    bool is_bad_ = false; // the next datagram is judged in the bad state
    LossState state_ = LossState::none;
};

/// Gilbert's model by measurable parameters: the share of losses, and the mean length of a run of
/// losses in datagrams (>= 1 and > share / (1 - share)).
struct Gilbert {
    base::Probability share{};
    double mean_burst = 1.0;

    static constexpr DropCause cause = DropCause::gilbert_elliott;
    static constexpr bool is_in_time = false;
    using Model = TwoStateChain;

    /// bad_to_good = 1 / L and good_to_bad = P / ((1 - P) L), for a share P and a mean burst L.
    [[nodiscard]] TwoStateSteps steps() const;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const Gilbert&, const Gilbert&) = default;
};

constexpr auto fields_of(base::Tag<Gilbert>)
{
    return base::fields("gilbert",
                        base::field("share", &Gilbert::share, "share that is lost").required(),
                        base::field("mean_burst", &Gilbert::mean_burst,
                                    "mean run of losses, in datagrams; at least 1")
                            .required());
}

/// The chain by its probabilities. It takes one step per datagram; a datagram is judged in the
/// state before the step, as tc-netem does it.
struct GilbertElliott {
    base::Probability good_to_bad{};
    base::Probability bad_to_good{};
    base::Probability loss_good{};
    base::Probability loss_bad = base::Probability::from_fraction(1.0).value();

    static constexpr DropCause cause = DropCause::gilbert_elliott;
    static constexpr bool is_in_time = false;
    using Model = TwoStateChain;

    [[nodiscard]] TwoStateSteps steps() const;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const GilbertElliott&, const GilbertElliott&) = default;
};

constexpr auto fields_of(base::Tag<GilbertElliott>)
{
    return base::fields(
        "gilbert-elliott",
        base::field("good_to_bad", &GilbertElliott::good_to_bad,
                    "probability of a step from good to bad")
            .required(),
        base::field("bad_to_good", &GilbertElliott::bad_to_good,
                    "probability of a step from bad to good")
            .required(),
        base::field("loss_good", &GilbertElliott::loss_good, "share lost in the good state"),
        base::field("loss_bad", &GilbertElliott::loss_bad, "share lost in the bad state"));
}

/// A Gilbert-Elliott chain in time instead of in datagrams: it stays good and bad for exponential
/// times of these means (> 0), whatever the rate of datagrams is.
struct TimedGilbertElliott {
    base::Duration mean_good{};
    base::Duration mean_bad{};
    base::Probability loss_good{};
    base::Probability loss_bad = base::Probability::from_fraction(1.0).value();

    static constexpr DropCause cause = DropCause::gilbert_elliott;
    static constexpr bool is_in_time = true;
    class Model;

    /// Returns the steps when the next datagram comes `after` this time. Sampling the chain like
    /// this is exact, whatever it did in between.
    [[nodiscard]] TwoStateSteps steps(base::Duration after) const;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const TimedGilbertElliott&, const TimedGilbertElliott&) = default;
};

constexpr auto fields_of(base::Tag<TimedGilbertElliott>)
{
    return base::fields(
        "timed-gilbert-elliott",
        base::field("mean_good", &TimedGilbertElliott::mean_good, "mean time in the good state")
            .required(),
        base::field("mean_bad", &TimedGilbertElliott::mean_bad, "mean time in the bad state")
            .required(),
        base::field("loss_good", &TimedGilbertElliott::loss_good, "share lost in the good state"),
        base::field("loss_bad", &TimedGilbertElliott::loss_bad, "share lost in the bad state"));
}

/// The first datagram is judged in a state that is drawn from the stationary law, whenever it
/// arrives.
class TimedGilbertElliott::Model {
public:
    Model(const TimedGilbertElliott& law, const base::RandomStream& stream);

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream& stream);
    void change(const TimedGilbertElliott& law, const base::RandomStream&);
    [[nodiscard]] LossState state() const { return is_bad_ ? LossState::bad : LossState::good; }

private:
    TimedGilbertElliott law_;
    bool is_bad_;
    std::optional<base::Duration> last_{}; // arrival of the previous datagram
};

} // namespace hapnet::emulator
