// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/plot_stream.hpp"

#include <span>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::peer::monitor {

namespace {

net::Endpoint any_port_for(const net::Endpoint& to)
{
    return net::resolve({to.family() == AF_INET6 ? "::" : "0.0.0.0", 0});
}

} // namespace

PlotStream::PlotStream(const net::Endpoint& to, std::uint16_t peer_id, control::FrameSource frames)
    : to_{to}, peer_id_{peer_id}, frames_{std::move(frames)}, socket_{any_port_for(to)}
{}

void PlotStream::serve(base::TimePoint now)
{
    if (next_ && !base::is_due(next_, now)) return;
    next_ = now + every;
    const double at_s = base::to_seconds(now.time_since_epoch());
    text_ = fmt::format(R"({{"timestamp":{:.6f},"peer_{}":)", at_s, peer_id_);
    const std::size_t head = text_.size();
    frames_(text_, 0);
    if (text_.size() == head) return; // no new frame
    if (text_.back() == '\n') text_.pop_back();
    text_ += '}';
    std::ignore = socket_.send(to_, std::as_bytes(std::span{text_}));
}

} // namespace hapnet::peer::monitor
