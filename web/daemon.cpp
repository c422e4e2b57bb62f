// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/daemon.hpp"

#include "proto/control/core/request.hpp"
#include "proto/net/clock.hpp"

#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::web {

Daemon::Daemon(boost::asio::io_context& io, const std::string& path, std::string every,
               Handlers handlers)
    : path_{path},
      handlers_{std::move(handlers)},
      watching_{
          io,
          path,
          {.on_open =
               [this, every = std::move(every)] {
                   watching_.send(fmt::format(
                       "{{\"command\":\"watch\",\"what\":\"frames\",\"every\":\"{}\"}}", every));
               },
           .on_line = [this](std::string_view line) { handlers_.on_frame(line); },
           .on_lost = [this](const std::string& why) { asking_.lose(why); }}},
      asking_{io,
              path,
              {.on_open =
                   [this] {
                       is_told_ = true;
                       handlers_.on_attached();
                   },
               .on_line = [this](std::string_view line) { on_reply(line); },
               .on_lost =
                   [this](const std::string& why) {
                       give_up(why);
                       if (std::exchange(is_told_, false)) handlers_.on_lost(why);
                   }}}
{}

void Daemon::ask(const std::string& request, OnReply on_reply)
{
    if (!is_attached()) return on_reply(base::fail("it is not attached"));
    if (asked_.size() >= asked_max) return on_reply(base::fail("it does not answer"));
    asked_.push_back({std::move(on_reply), net::monotonic_now() + patience});
    asking_.send(request);
}

void Daemon::on_reply(std::string_view line)
{
    if (asked_.empty()) return;
    auto asked = std::move(asked_.front());
    asked_.pop_front();
    asked.on_reply(control::parse_object(line));
}

void Daemon::tick(base::TimePoint now)
{
    // A late reply would be taken for the reply to the next request, so the connection is made
    // again.
    if (!asked_.empty() && asked_.front().deadline <= now) asking_.lose("it does not answer");
}

void Daemon::give_up(const std::string& why)
{
    for (auto& asked : std::exchange(asked_, {})) asked.on_reply(base::fail(why));
}

} // namespace hapnet::web
