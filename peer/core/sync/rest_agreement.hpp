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
/// compares the body's places at rest in both copies, at a tick of the session by which both had
/// come to this rest. Copies that were computed from the same hands are therefore left alone,
/// whatever the delay. Fed with the ticks of this copy and with the messages of the other.
class RestAgreement {
public:
    /// The other copy at a tick of the session.
    struct Word {
        std::size_t from = 0;   // index of the peer whose copy it is
        std::int64_t tick = -1; // tick of the session
        /// Up to this tick at least, the copy was made from the true hands; -1: not known.
        std::int64_t knows = -1;
        base::Position body;
    };

    /// This copy after that tick. True: a hand touches the body.
    bool play(std::int64_t tick, const scene::World& world, scene::BodyId body);
    void hear(const Word& word);
    /// Returns the displacement by which the body is to be moved now, at once; nullopt: none, or
    /// not yet. `rest`: the number of ticks for which it must have rested in both copies.
    [[nodiscard]] std::optional<base::Displacement> take_way(std::int64_t rest);

private:
    /// A copy's body at rest, as far as it is known.
    struct Rest {
        base::Position place;
        std::int64_t since = 0;
        std::int64_t until = -1;
    };

    Rest own_;
    std::optional<Rest> others_; // the other copy, since it knew all hands up to own_.since
    std::size_t from_ = 0;
};

/// Returns the other peer whose copy this one yields to; nullopt: none that is heard.
[[nodiscard]] std::optional<std::size_t> yields_to(const Situation& situation);

} // namespace hapnet::peer
