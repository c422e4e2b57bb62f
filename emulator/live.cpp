// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/live.hpp"

#include "emulator/control/reply.hpp"
#include "emulator/input_file.hpp"

#include <tuple>
#include <utility>

namespace hapnet::emulator {

Live::Live(Setup setup, Relay& relay)
    : relay_{relay},
      director_{std::move(setup.profile), relay.start()},
      emulation_{director_,
                 [this](const Path& path, base::TimePoint now) { relay_.change(path, now); },
                 [this] {
                     return NextNumbers{relay_.a().link.statistics().received,
                                        relay_.b().link.statistics().received};
                 },
                 std::move(setup.statistics_json),
                 [](const std::string& name, const std::string& beside) {
                     return read_input_file(name, beside);
                 }}
{
    if (setup.socket) server_.emplace(*std::move(setup.socket));
}

std::optional<base::TimePoint> Live::next_deadline() const
{
    return base::earlier(director_.next_change(),
                         server_ ? server_->next_deadline() : std::nullopt);
}

void Live::update(base::TimePoint now)
{
    if (director_.advance(now)) relay_.change(director_.path(), now);
    if (server_) server_->serve(emulation_, now, relay_.next_deadline());
}

void Live::apply(const Profile& profile, base::TimePoint now)
{
    std::ignore = carry_out(Apply{profile}, emulation_, now);
}

} // namespace hapnet::emulator
