// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/situation.hpp"
#include "scene/world.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// Makes copies that play the session tick by tick agree again after messages were lost. It
/// compares the resting places of the body in both copies, at a tick of the session at which both
/// had already come to this rest. So it does not change copies that were computed from the same
/// hands, whatever the delay. It takes the ticks of this copy and the messages of the other.
class RestAgreement {
public:
    /// The state of the other copy at a tick of the session.
    struct Word {
        std::size_t from = 0;   // index of the peer whose copy it is
        std::int64_t tick = -1; // tick of the session
        /// The last tick up to which the copy is known to be computed from the true hands; -1: not
        /// known.
        std::int64_t knows = -1;
        base::Position body;
    };

    /// Takes this copy after that tick. Returns true if a hand touches the body.
    bool play(std::int64_t tick, const scene::World& world, scene::BodyId body);
    void hear(const Word& word);
    /// Returns the displacement by which the body has to be moved at once; nullopt: none, or not
    /// yet. `rest` is the number of ticks for which it must have rested in both copies.
    [[nodiscard]] std::optional<base::Displacement> take_way(std::int64_t rest);

private:
    /// The known rest of the body in a copy.
    struct Rest {
        base::Position place;
        std::int64_t since = 0;
        std::int64_t until = -1;
    };

    Rest own_;
    std::optional<Rest> others_; // the other copy, from when it knew all hands to own_.since
    std::size_t from_ = 0;
};

/// Returns the other peer to whose copy this one yields; nullopt if no such peer is heard.
[[nodiscard]] std::optional<std::size_t> yields_to(const Situation& situation);

} // namespace hapnet::peer
