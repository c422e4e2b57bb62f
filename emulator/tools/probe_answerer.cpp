// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/probe_answerer.hpp"

#include <algorithm>

namespace hapnet::emulator::tools {

void ProbeAnswerer::Session::count(std::uint64_t sequence)
{
    if (heard == 0 || sequence > highest) {
        const auto first_new = heard == 0 ? 0 : highest + 1;
        if (heard == 0 || sequence - highest >= window) {
            seen.reset();
        } else {
            for (auto number = first_new; number < sequence; ++number) seen.reset(number % window);
        }
        highest = sequence;
    } else if (highest - sequence >= window || seen.test(sequence % window)) {
        return;
    }
    seen.set(sequence % window);
    ++heard;
}

std::optional<ProbeMessage> ProbeAnswerer::answer(const ProbeMessage& question,
                                                  base::TimePoint received)
{
    if (question.is_answer) return std::nullopt;
    Session& session = session_of(question.session);
    session.last = received;
    session.count(question.sequence);
    ProbeMessage answer = question;
    answer.is_answer = true;
    answer.received = received;
    answer.answered = received;
    answer.heard = session.heard;
    answer.boot = boot_;
    return answer;
}

/// A new one takes the place of the one that has been silent longest.
ProbeAnswerer::Session& ProbeAnswerer::session_of(std::uint64_t id)
{
    const auto known = std::ranges::find(sessions_, id, &Session::id);
    if (known != sessions_.end()) return *known;
    if (sessions_.size() < sessions_max) return sessions_.emplace_back(Session{.id = id});
    Session& oldest = *std::ranges::min_element(sessions_, {}, &Session::last);
    oldest = Session{.id = id};
    return oldest;
}

} // namespace hapnet::emulator::tools
