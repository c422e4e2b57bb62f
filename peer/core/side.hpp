// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/governor.hpp"
#include "peer/core/peer.hpp"
#include "peer/core/timer.hpp"
#include "proto/record/rows.hpp"

#include <concepts>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <span>

namespace hapnet::peer {

/// A device behind its governor, in the scene's frame, such as device::Rig. A loop with a watchdog
/// and the replay of a record have rigs of their own.
template <typename R>
concept RigLike = requires(R rig, base::Force wanted, base::TimePoint now, device::Cue cue)
{
    {
        rig.read(now)
        } -> std::convertible_to<const device::Sample&>;
    {
        rig.apply(wanted, true, now)
        } -> std::same_as<base::Force>;
    {
        rig.governor_state()
        } -> std::same_as<device::GovernorState>;
    rig.on_cue(cue);
};

/// One side of a session: its device, its copy of the scene and the session, without clock, socket
/// or thread. The daemon's loop, the players in virtual time, the replay of records and the tests
/// all use it. Feed it with on_datagram(), call step() once per tick, then drain poll() and
/// notice().
class Side {
public:
    /// `settings.scene` must be accepted by shared_body() and World::freeze().
    explicit Side(const Settings& settings)
        : peer_{settings}, id_{settings.introduction.id}, mount_scale_{settings.mount_scale}
    {}

    void on_datagram(std::span<const std::byte> datagram, base::TimePoint arrived,
                     std::size_t from = 0)
    {
        peer_.on_datagram(datagram, arrived, from);
    }

    /// Plays one tick in this order: reads the device, advances session and scene, has the force
    /// governed and applied, and informs the device of a new start.
    template <RigLike Rig>
    const Tick& step(base::TimePoint now, Rig& rig)
    {
        const bool was_in_hand = is_in_hand(sample_);
        const base::Position before = sample_.hip;
        sample_ = rig.read(now);
        const bool in_hand = is_in_hand(sample_);
        if (was_in_hand && in_hand) work_j_ += work_since(before);
        const Tick& tick = peer_.tick(
            now, {sample_.hip, sample_.velocity, sample_.gripping, in_hand, work_j_, told_});
        told_ = rig.apply(tick.force, tick.permitted, now);
        governor_state_ = rig.governor_state();
        if (is_cue_due()) rig.on_cue(take_cue());
        return tick;
    }

    /// See Peer::poll() and Peer::notice().
    [[nodiscard]] const wire::Datagram* poll(std::size_t to = 0) { return peer_.poll(to); }
    [[nodiscard]] const Notice* notice() { return peer_.notice(); }

    [[nodiscard]] Peer& peer() { return peer_; }
    [[nodiscard]] const Peer& peer() const { return peer_; }

    // Values of the last step.
    [[nodiscard]] const device::Sample& sample() const { return sample_; }
    [[nodiscard]] const Tick& tick() const { return peer_.last(); }
    /// Returns the force at the hand that was sent to the device, after the governor.
    [[nodiscard]] base::Force told() const { return told_; }
    /// Returns the last step as a row of a record. The caller gives the number and time of the
    /// tick.
    [[nodiscard]] record::TickRow row(std::uint64_t number, const TickTime& time) const;
    /// Returns the state of one of peer().shared() after the last step as a row of a record.
    [[nodiscard]] record::BodyRow body_row(std::uint64_t number, const SharedBody& body) const;

private:
    [[nodiscard]] bool is_cue_due() const
    {
        const auto& session = peer_.session();
        return session && cued_ != session->start;
    }
    [[nodiscard]] device::Cue take_cue();
    /// Returns the work of the hand against the last force on it, in J, since it was at `before`.
    [[nodiscard]] double work_since(base::Position before) const
    {
        return -glm::dot(told_.value, (sample_.hip - before).value) / mount_scale_;
    }

    Peer peer_;
    std::uint16_t id_;
    double mount_scale_;
    double work_j_ = 0.0; // work of the hand on its device since the start
    device::Sample sample_;
    base::Force told_;
    device::GovernorState governor_state_ = device::GovernorState::off;
    std::optional<base::TimePoint> cued_; // session start of the last cue
};

/// Returns the sample that Side::row() has written into a row.
[[nodiscard]] device::Sample sample_of(const record::TickRow& row);

} // namespace hapnet::peer
