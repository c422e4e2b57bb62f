// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/reception.hpp"

#include "peer/control/answer.hpp"
#include "peer/monitor/report.hpp"

#include <utility>

namespace hapnet::peer {

namespace {

constexpr base::Duration question_every{std::chrono::milliseconds{50}};

} // namespace

Reception::Reception(Parts parts) : parts_{std::move(parts)}, subject_{subject()} {}

control::Subject Reception::subject()
{
    const auto run = [this] {
        return Run{parts_.options, *standing_, parts_.journal, parts_.device,
                   !parts_.watcher.record_failure()};
    };
    return subject_of({.show = [this, run] { return show_json(run(), parts_.ways_back); },
                       .statistics =
                           [this, run] {
                               nlohmann::ordered_json json = statistics_json(run());
                               json["elapsed_s"] = base::to_seconds(standing_->elapsed);
                               return json;
                           },
                       .stop = [this] { parts_.servo.stop(); }});
}

void Reception::serve(base::TimePoint now)
{
    if (Standing newer; parts_.servo.take_standing(newer)) standing_ = newer;
    if (!next_question_ || base::is_due(next_question_, now)) {
        parts_.servo.ask_standing();
        next_question_ = now + question_every;
    }
    if (standing_) parts_.server.serve(subject_, now, std::nullopt);
}

} // namespace hapnet::peer
