// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "emulator/core/loss/burst.hpp"
#include "emulator/core/loss/four_state.hpp"
#include "emulator/core/loss/gilbert.hpp"
#include "emulator/core/loss/k_of_n.hpp"
#include "emulator/core/loss/list.hpp"
#include "emulator/core/loss/outage.hpp"
#include "emulator/core/loss/pattern.hpp"
#include "emulator/core/loss/periodic.hpp"
#include "emulator/core/loss/random.hpp"
#include "emulator/core/loss/theory.hpp"
#include "emulator/core/loss/timed_trace.hpp"
#include "emulator/core/loss/trace.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

#include <concepts>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace hapnet::emulator {

// The laws of loss. Each has a file of its own with its parameters, its model, its theory, and the
// check of its parameters; docs/design/add-a-loss-law.md explains how to add one.

/// A law, as a person states it. A law that advances by datagrams counts every datagram of its
/// direction, whatever other laws do to it.
using LossLaw = std::variant<RandomLoss, BlockLoss, PeriodicLoss, Burst, TimedBurst, Gilbert,
                             GilbertElliott, TimedGilbertElliott, FourState, ListedLoss,
                             PatternLoss, TraceLoss, TimedTraceLoss, Outage>;

/// A running law. It is made from the law and a random stream, sees every datagram in the order of
/// their numbers, decides whether each is lost, and can be changed to other parameters. A model
/// with states also has
///
/// LossState state() const; the state in which the last datagram was judged
template <typename Model, typename Law>
concept LossModelOf = requires(Model model, const Law& law, const base::RandomStream& stream,
                               const Packet& packet)
{
    Model{law, stream};
    requires std::same_as<decltype(model.on_packet(packet, stream)), bool>;
    model.change(law, stream);
};

/// Requirements that every law of loss meets. fields_of() gives its name in profiles and streams,
/// and its parameters.
template <typename Law>
concept LawOfLoss = base::Described<Law> && std::equality_comparable<Law> &&
    LossModelOf<typename Law::Model, Law> &&
    requires(const Law& law, const Arrivals& arrivals, const RunFacts& facts)
{
    // the cause of its drops, in statistics and fates
    requires std::convertible_to<decltype(Law::cause), DropCause>;
    // true if its losses depend on the arrival times of datagrams
    requires std::convertible_to<decltype(Law::is_in_time), bool>;
    // refuses impossible parameters, in the units that a person writes
    requires std::same_as<decltype(law.validate()), base::Result<void>>;
    // closed forms for people
    requires std::same_as<decltype(law.theory(arrivals)), LossTheory>;
    // the tests that a run of the law passes
    requires std::same_as<decltype(law.properties(facts)), std::vector<LossProperty>>;
};

/// Runs one law of some laws, one datagram after the other. The fate of datagram n is a function of
/// the stream and of n, and for laws with a state or in time also of the datagrams before.
/// Allocates nothing. The law must be one that validate() accepts.
template <typename Laws>
class LossProcessOf;

template <LawOfLoss... Laws>
class LossProcessOf<std::variant<Laws...>> {
public:
    using Law = std::variant<Laws...>;

    LossProcessOf(const Law& law, const base::RandomStream& stream)
        : stream_{stream}, running_{started(law, stream)}
    {}

    /// Returns why the datagram is lost; nullopt: it passes. Call it once for every datagram of the
    /// direction, in the order of their numbers.
    [[nodiscard]] std::optional<DropCause> on_packet(const Packet& packet)
    {
        return std::visit(
            [&]<typename One>(Running<One>& running) -> std::optional<DropCause> {
                const bool is_lost = running.model.on_packet(packet, stream_);
                if constexpr (requires { running.model.state(); }) state_ = running.model.state();
                return is_lost ? std::optional{One::cause} : std::nullopt;
            },
            running_);
    }

    /// Returns the state in which the law judged the last datagram.
    [[nodiscard]] LossState state() const { return state_; }

    /// Changes the law from the next datagram on. A law of the same kind continues from its state.
    void change(const Law& law)
    {
        std::visit(
            [&]<typename One>(const One& one) {
                if (auto* running = std::get_if<Running<One>>(&running_)) {
                    running->model.change(one, stream_);
                } else {
                    running_ = started(one, stream_);
                    state_ = LossState::none;
                }
            },
            law);
    }

private:
    /// The model of one law. The law is part of the type because laws may share a type of model.
    template <typename One>
    struct Running {
        typename One::Model model;
    };
    using AnyRunning = std::variant<Running<Laws>...>;

    [[nodiscard]] static AnyRunning started(const Law& law, const base::RandomStream& stream)
    {
        return std::visit(
            [&]<typename One>(const One& one) {
                return AnyRunning{Running<One>{typename One::Model{one, stream}}};
            },
            law);
    }

    base::RandomStream stream_;
    AnyRunning running_;
    LossState state_ = LossState::none;
};

extern template class LossProcessOf<LossLaw>;
using LossProcess = LossProcessOf<LossLaw>;

/// "random", "k-of-n", ...: the name of a law in profiles and in the name of its stream.
[[nodiscard]] std::string_view name_of(const LossLaw& law);

/// Refuses an impossible law. The error says what is impossible and what would be right, in the
/// units that a person writes, without naming the law or the place.
[[nodiscard]] base::Result<void> validate(const LossLaw& law);

/// True if the losses depend on the arrival times of datagrams.
[[nodiscard]] bool is_in_time(const LossLaw& law);

[[nodiscard]] LossTheory theory_of(const LossLaw& law, const Arrivals& arrivals);
[[nodiscard]] std::vector<LossProperty> properties_of(const LossLaw& law, const RunFacts& facts);

} // namespace hapnet::emulator
