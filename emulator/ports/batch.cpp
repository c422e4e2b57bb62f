// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/batch.hpp"

#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

namespace hapnet::emulator::ports {

namespace {

DropCause cause_of(net::SendOutcome outcome)
{
    switch (outcome) {
    case net::SendOutcome::sent: break;
    case net::SendOutcome::buffer_full: return DropCause::send_buffer_full;
    case net::SendOutcome::no_route: return DropCause::no_route;
    case net::SendOutcome::too_big: return DropCause::too_big;
    case net::SendOutcome::refused: return DropCause::refused;
    case net::SendOutcome::failed: return DropCause::send_failed;
    }
    base::ensure(false);
    return DropCause::send_failed;
}

} // namespace

void Batch::flush()
{
    if (count_ == 0) return;
    base::ensure(exit_.destination.has_value());
    const auto outcomes = exit_.socket.send_batch(*exit_.destination, {bytes_.data(), count_});
    const auto at = net::monotonic_now();
    for (std::size_t i = 0; i < count_; ++i) {
        if (outcomes[i] == net::SendOutcome::sent) {
            on_sent(departures_[i], at);
        } else {
            path_.on_failed(direction_, departures_[i], cause_of(outcomes[i]));
        }
    }
    count_ = 0;
}

void Batch::on_sent(const Datagram& departure, base::TimePoint at)
{
    if (recorder_.captures()) {
        recorder_.on_departure({.side = exit_.side,
                                .is_outbound = true,
                                .at = at,
                                .from = udp_address_of(exit_.local),
                                .to = udp_address_of(*exit_.destination),
                                .payload = departure.bytes},
                               at - departure.due, departure.is_copy);
    }
    path_.on_sent(direction_, departure, at); // its bytes go
}

bool send_due(EmulatedPath& path, Direction direction, const Exit& exit, Recorder& recorder,
              base::TimePoint now)
{
    if (!base::is_due(path.link(direction).next_deadline(), now)) return false;
    Batch due{path, direction, exit, recorder};
    for (std::size_t i = 0; i < net::BatchSender::batch_max; ++i) {
        const auto departure = path.poll(direction, now);
        if (!departure) {
            due.flush();
            return false;
        }
        due.add(*departure);
    }
    return true;
}

} // namespace hapnet::emulator::ports
