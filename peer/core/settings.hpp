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
    Roster roster; // the others; with more than one: plays_with_many()
    scene::Description scene = scene::paper_scene(); // one that shared_bodies() accepts
    Algorithm algorithm; // one that check_bodies_of() and check_hands_of() accept
    /// Damping of the device and the loosest grip on it. It bounds the contacts that can be
    /// rendered without the hand drawing energy from them (passive_share). The default is a nominal
    /// grip on a stylus, and an assumption: fingertips were measured at 4 to 7.4 N s/m (A. Z.
    /// Hajian, R. D. Howe: Identification of the mechanical impedance at the human finger tip,
    /// 1997).
    double grip_damping_ns_per_m = 4.0;
    /// Stiffest contact that the device renders without buzzing, in the scene; 0: not known.
    double stiffness_max_n_per_m = 0.0;
    /// Metres in the scene for each metre that the hand moves.
    double mount_scale = 1.0;
    SendPolicy send;                 // when the others are told
    Playout playout = Playout::none; // when what they say counts
    Staleness staleness;
    base::Duration tick{std::chrono::milliseconds{1}};
    base::Duration length{std::chrono::seconds{30}}; // of the session, from its start
    bool measures_paths = false;                     // to the others, for statistics; 80 KiB each
};

} // namespace hapnet::peer
