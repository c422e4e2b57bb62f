// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/energy_at_an_omni.hpp"
#include "peer/core/sync/pose_correction.hpp"
#include "peer/core/sync/proxy_hand.hpp"

#include <chrono>
#include <optional>
#include <vector>

namespace hapnet::peer {

struct RemoteProxyOptions {
    ProxyHandOptions proxy{.hand = {.friction_n = 0.26}}; // an Omni's friction
    double account_j = 0.030;
    double power_w = 0.4; // four times what the tasks take
    double correction_rate_hz = 20.0;
    double correction_speed_m_per_s = 0.25;

    friend bool operator==(const RemoteProxyOptions&, const RemoteProxyOptions&) = default;
};
constexpr auto fields_of(base::Tag<RemoteProxyOptions> /*struct*/)
{
    using Options = RemoteProxyOptions;
    return base::fields(
        "remote-proxy", base::part(&Options::proxy),
        base::field("account", &Options::account_j, base::Quantity{base::energy_kind, 0.0, 10.0},
                    "energy that the proxies may give before their owners' work is known"),
        base::field("power", &Options::power_w, base::Quantity{base::power_kind, 0.0, 100.0},
                    "energy in addition for each second of the largest age"),
        base::field("correction_rate", &Options::correction_rate_hz,
                    base::Quantity{base::frequency_kind, 0.0, 1000.0},
                    "rate at which the copies' difference decays while the own hand is off"),
        base::field("correction_speed", &Options::correction_speed_m_per_s,
                    base::Quantity{base::speed_kind, 0.0, 10.0},
                    "greatest speed of that correction"));
}

/// Represents the other hands as hands in this copy, each drawn to the place where its owner
/// intends to be (remote dynamic proxies, Li and Constantinescu; the intention, Takagi et al.
/// 2017). No delayed force is fed back: only the error of the model closes the loop. The energy
/// that all proxies together may put into this copy is limited to the work that their owners have
/// put in, by their running sums (passive set-position modulation, Lee and Huang). So the copies
/// together stay passive even over a bad network and with a wrong model of a hand. The page of the
/// algorithms derives the bound, and a property test checks it in sessions over random networks.
class RemoteProxy {
public:
    /// The energy that the algorithm may bring into a hand at an Omni.
    static constexpr auto energy_limits = energy_at_an_omni(0.4);

    RemoteProxy() : RemoteProxy(RemoteProxyOptions{}) {}
    explicit RemoteProxy(const RemoteProxyOptions& options);

    /// Allocates the memory for this number of other peers and for the bodies of this world.
    void prepare(std::size_t others, const scene::World& world);
    void hear(const ReceivedState& received);
    [[nodiscard]] Outcome tick(scene::World& world, const Situation& situation);
    void forget(std::size_t of = 0);

    [[nodiscard]] const RemoteProxyOptions& options() const { return options_; }
    /// Returns the energy that the proxies may still give, in J.
    [[nodiscard]] double account_j() const { return account_j_; }
    [[nodiscard]] const std::vector<ProxyHand>& proxies() const { return proxies_; }

    /// The time after the last known touch during which the last toucher's copy is authoritative.
    /// After it, the copy of the lowest id is. The time is longer than the largest age that has an
    /// allowance.
    static constexpr base::Duration last_touch_counts_for{std::chrono::milliseconds{500}};

private:
    /// The other peer whose hand touched last.
    struct Leader {
        std::size_t index = 0;
        base::TimePoint touched;
    };
    /// The state of this copy in an earlier tick.
    struct Past {
        glm::dvec3 place{0.0};
        glm::dvec3 corrected{0.0};
    };

    void lend();
    void look(const scene::World& world, const Situation& situation);
    void act(scene::World& world, const Situation& situation);
    [[nodiscard]] ProxyHand::View view_of(std::size_t other, const scene::World& world,
                                          const Situation& situation) const;
    [[nodiscard]] double share() const;
    void move_proxies(const scene::World& world, const Situation& situation, double share,
                      Outcome& outcome);
    [[nodiscard]] std::optional<std::size_t> leader(const Situation& situation) const;
    [[nodiscard]] static std::optional<std::size_t> lowest(const Situation& situation);
    [[nodiscard]] bool is_anyone_touching(const Situation& situation) const;
    [[nodiscard]] glm::dvec3 error_against(std::size_t leader, const Situation& situation,
                                           const scene::BodyState& body) const;
    void correct(scene::World& world, const Situation& situation);
    void remember(const scene::World& world, const Situation& situation);

    static constexpr std::size_t past_max = 4096; // ticks

    RemoteProxyOptions options_;
    std::vector<ProxyHand> proxies_; // one for each of the others, in their order
    std::vector<base::Force> rubbing_;
    /// Used for bodies that turn, or for several; if it is nullopt, correct() and remember() are
    /// used.
    std::optional<PoseCorrection> poses_;
    std::vector<Past> past_; // ring of past_max ticks
    std::uint64_t ticks_ = 0;
    double account_j_ = 0.0;
    double lent_j_ = 0.0; // the largest allowance so far
    double allowance_j_ = 0.0;
    std::optional<base::TimePoint> touched_; // last touch by this peer's hand
    bool own_hand_touches_ = false;
    glm::dvec3 corrected_{0.0};   // the sum of all corrections
    glm::dvec3 proxy_force_{0.0}; // force of all proxies on the body, in the last tick
};

} // namespace hapnet::peer
