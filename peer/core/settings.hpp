// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/others.hpp"
#include "peer/core/playout.hpp"
#include "peer/core/send_policy.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "scene/description.hpp"

namespace hapnet::peer {

struct Settings {
    Introduction introduction;
    /// The other peers. If there are several, plays_with_many() must be true for the algorithm.
    Roster roster;
    scene::Description scene = scene::paper_scene(); // must be accepted by shared_bodies()
    Algorithm algorithm; // must be accepted by check_bodies_of() and check_hands_of()
    /// The damping of the device with the loosest grip on it. It limits the contacts that can be
    /// rendered without the hand drawing energy from them (passive_share). The default is an
    /// assumption, for a nominal grip on a stylus: fingertips were measured at 4 to 7.4 N s/m (A.
    /// Z. Hajian, R. D. Howe: Identification of the mechanical impedance at the human finger tip,
    /// 1997).
    double grip_damping_ns_per_m = 4.0;
    /// The stiffest contact in the scene that the device renders without buzzing; 0: not known.
    double stiffness_max_n_per_m = 0.0;
    /// The motion in the scene, in metres, for each metre that the hand moves.
    double mount_scale = 1.0;
    SendPolicy send;                 // when states are sent to the other peers
    Playout playout = Playout::none; // when received states are given to the algorithm
    Staleness staleness;
    base::Duration tick{std::chrono::milliseconds{1}};
    base::Duration length{std::chrono::seconds{30}}; // length of the session from its start
    bool measures_paths = false;                     // for statistics; takes 80 KiB per other peer
};

} // namespace hapnet::peer
