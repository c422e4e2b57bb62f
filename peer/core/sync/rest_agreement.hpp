// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/situation.hpp"
#include "scene/world.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// How copies that play the session tick by tick agree again after messages were lost. Where the
/// body rests in this copy is compared with where it rests in the other's, at a tick of the session
/// by which both had come to this rest: so copies that were made of the same hands are left alone,
/// whatever the delay. Fed with the ticks of this copy and with the messages of the other.
class RestAgreement {
public:
    /// The other copy at a tick of the session.
    struct Word {
        std::size_t from = 0;    // whose copy it is
        std::int64_t tick = -1;  // of the session
        std::int64_t knows = -1; // until that tick, at least, it is made of the hands as they were
        base::Position body;
    };

    /// This copy after that tick. True: a hand touches the body.
    bool play(std::int64_t tick, const scene::World& world, scene::BodyId body);
    void hear(const Word& word);
    /// By how far the body is to be moved now, at once; nullopt: it is not, or not yet. `rest`: for
    /// so many ticks it is to have rested in both copies.
    [[nodiscard]] std::optional<base::Displacement> take_way(std::int64_t rest);

private:
    /// A copy's body at rest, as far as it is known.
    struct Rest {
        base::Position place;
        std::int64_t since = 0;
        std::int64_t until = -1;
    };

    Rest own_;
    std::optional<Rest> others_; // as of when it knew all hands up to own_
    std::size_t from_ = 0;
};

/// Which of the others' copies this one yields to; nullopt: none that is heard.
[[nodiscard]] std::optional<std::size_t> yields_to(const Situation& situation);

} // namespace hapnet::peer
