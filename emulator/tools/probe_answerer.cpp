// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/probe_answerer.hpp"

#include <algorithm>

namespace hapnet::emulator::tools {

std::optional<ProbeMessage> ProbeAnswerer::answer(const ProbeMessage& question,
                                                  base::TimePoint received)
{
    if (question.is_answer) return std::nullopt;
    Session& session = session_of(question.session);
    session.last = received;
    // A question that is too old to decide counts as a copy.
    if (session.questions.add(question.sequence) == base::Seen::no) ++session.heard;
    ProbeMessage answer = question;
    answer.is_answer = true;
    answer.received = received;
    answer.answered = received;
    answer.heard = session.heard;
    answer.boot = boot_;
    return answer;
}

/// Returns the session. A new one replaces the one that has been silent longest.
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
