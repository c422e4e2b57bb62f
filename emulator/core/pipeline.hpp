// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/delay/delay.hpp"
#include "emulator/core/fate.hpp"
#include "emulator/core/loss/loss.hpp"
#include "emulator/core/packet.hpp"
#include "emulator/core/regime_chain.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// Draws the fates of the datagrams of one direction. Every stage sees every datagram, even if
/// another stage has dropped it, so that no stage can shift the draws of another. The first drop is
/// final. Stage S of direction D draws from the stream "D/S" of the seed ("up/jitter",
/// "down/loss/random", ...) and from no other.
///
/// The stages, always in this order: mtu, loss (law after law), corrupt, duplicate, delay, jitter,
/// reorder. Link handles the rate and the order of departure.
///
/// With regimes, the stages of the regime at the arrival of a datagram draw its fate. For a setting
/// that the regime does not have, the stages of the direction do. The stages of regime R draw from
/// "D/regime/R/S". The chain of the regimes draws from "D/regime", or from "both/regime" if both
/// directions share their regimes.
class Pipeline {
public:
    /// The names of the random streams begin with the name of the path, if it has one:
    /// "client/1/up/jitter"; see stream_name().
    Pipeline(const Conditions& conditions, base::Seed seed, Direction direction,
             std::string_view path = {});

    // Both are defined in pipeline.cpp, where the class of the regimes is complete.
    ~Pipeline();
    Pipeline(Pipeline&&) noexcept;
    Pipeline& operator=(Pipeline&&) noexcept;
    Pipeline(const Pipeline& other);
    Pipeline& operator=(const Pipeline&) = delete;

    /// Returns the fate of a packet. Call it for every packet in the order of their numbers.
    [[nodiscard]] Fate on_packet(const Packet& packet)
    {
        return regimes_ == nullptr ? own_fate(packet) : fate_at(packet);
    }
    /// Returns the fate as if the regime with this index were in effect. Ensures that there are
    /// regimes.
    [[nodiscard]] Fate on_packet(const Packet& packet, std::size_t regime);

    /// Returns the chain of the regimes in its initial state; nullopt: there are none.
    [[nodiscard]] std::optional<RegimeChain> chain() const;
    /// Returns the time and the stays of each regime until this time; empty: there are none.
    [[nodiscard]] std::vector<RegimeCourse> regime_course(base::Duration until) const;

    /// Returns the random stream of another stage of this direction.
    [[nodiscard]] base::RandomStream stream(std::string_view stage) const;

    /// Changes the conditions from the next packet on. Laws that stay continue from their states.
    void change(const Conditions& conditions);

private:
    /// The index of a law among those of its kind: the first random loss, the second one, the first
    /// burst, ...
    struct LawIndex {
        std::size_t kind = 0;
        std::size_t occurrence = 1;

        friend bool operator==(const LawIndex&, const LawIndex&) = default;
    };
    struct LossStage {
        LawIndex position;
        LossProcess process;
    };

    /// The draws for a datagram of those stages that have a memory.
    struct Draws {
        std::optional<DropCause> lost{};
        std::array<LossState, loss_laws_max> states{};
        base::Duration delay{};
        base::Duration jitter{};
    };
    struct InRegimes;

    Pipeline(const Conditions& conditions, base::Seed seed, std::string way, std::string both_ways);

    [[nodiscard]] Fate own_fate(const Packet& packet);
    [[nodiscard]] Fate fate_at(const Packet& packet);
    [[nodiscard]] Draws draw(const Packet& packet);
    void corrupt(Fate& fate, std::uint64_t number) const;
    void duplicate(Fate& fate, std::uint64_t number) const;
    void reorder(Fate& fate, std::uint64_t number) const;
    void change_regimes(const Regimes& regimes);
    static LawIndex index_of(const std::vector<LossLaw>& laws, std::size_t index);
    [[nodiscard]] LossStage loss_stage(const std::vector<LossLaw>& laws, std::size_t index) const;
    void change_losses(const std::vector<LossLaw>& laws);
    [[nodiscard]] bool is_above_mtu(const Packet& packet) const;
    [[nodiscard]] Flips draw_flips(std::uint64_t number) const;
    [[nodiscard]] base::Duration draw_copy(std::uint64_t number) const;

    base::Seed seed_;
    std::string way_;       // prefix of the names of its random streams
    std::string both_ways_; // prefix for draws that both directions share
    Mtu mtu_;
    std::vector<LossStage> loss_;
    Corruption corrupt_;
    base::RandomStream corrupt_stream_;
    Duplication duplicate_;
    base::RandomStream duplicate_stream_;
    DelayProcess delay_;
    DelayProcess jitter_;
    Reordering reorder_;
    base::RandomStream reorder_stream_;
    std::unique_ptr<InRegimes> regimes_; // null: there are no regimes
};

} // namespace hapnet::emulator
