// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/proxy_hand.hpp"
#include "peer/core/sync/shared_poses.hpp"
#include "peer/core/sync/situation.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::peer {

/// The part of remote-proxy that keeps copies consistent if bodies turn, or if there are several. A
/// body that this hand does not move is shifted a little in each tick. While others move it, it
/// approaches its predicted present pose in the copy of the lowest id among them. Once no hand
/// moves it, its difference from its owner's copy at the same past time is corrected. Both poses of
/// that time are known, so the delay is not in the loop. After a while SharedPoses removes the
/// remaining difference.
class PoseCorrection {
public:
    struct Rates {
        double rate_hz = 20.0; // rate at which a difference decays
        /// The greatest speed of the correction, both of the body's centre and, by turning, of its
        /// farthest point.
        double speed_m_per_s = 0.25;
    };
    PoseCorrection(std::size_t bodies, const Rates& rates);

    /// Clears the pushes of the previous tick. Call it before the first add_push() of a tick.
    void begin_pushes();
    /// Adds the push of a proxy on a body in this tick. `lever` begins at the body's centre.
    void add_push(std::size_t body, base::Force force, base::Displacement lever);

    /// A copy of the scene after the world's tick, and the other peers.
    struct Copy {
        scene::World& world;
        const Situation& situation;
        std::span<const ProxyHand> proxies;
    };
    /// Corrects the bodies. Returns the energy that the corrections gave to this copy, in J, by
    /// stretching contacts of proxies and by lifting bodies.
    [[nodiscard]] double keep_together(const Copy& copy);

private:
    /// A displacement of a body, and a rotation about its centre in radians.
    struct Motion {
        glm::dvec3 way{0.0};
        glm::dvec3 turn{0.0};
    };
    /// The state of a body in an earlier tick.
    struct Past {
        glm::dvec3 place{0.0};
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
        Motion corrected;
    };
    struct Body {
        Motion corrected;       // the sum of all corrections
        glm::dvec3 force{0.0};  // force of all proxies on the body in the last tick
        glm::dvec3 torque{0.0}; // torque of all proxies about its centre in the last tick
        std::optional<base::TimePoint> touched; // last touch by this hand, also indirect
        std::vector<Past> past;                 // ring of past_max ticks
    };

    [[nodiscard]] double follow(const Copy& copy, std::size_t body, std::size_t leader);
    [[nodiscard]] double settle(const Copy& copy, std::size_t body);
    [[nodiscard]] std::optional<Motion> error_in_past(const Copy& copy, std::size_t body) const;
    [[nodiscard]] double correct(const Copy& copy, std::size_t body, const Motion& error);
    void remember(const Copy& copy);

    static constexpr std::size_t past_max = 4096; // ticks

    Rates rates_;
    std::vector<Body> bodies_;
    std::uint64_t ticks_ = 0;
};

} // namespace hapnet::peer
