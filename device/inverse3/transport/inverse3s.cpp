// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/inverse3/transport/inverse3s.hpp"

#include "device/inverse3/messages.hpp"
#include "device/inverse3/transport/inverse3_exchange.hpp"
#include "device/transport/polled_device.hpp"
#include "proto/net/web_socket_client.hpp"

#include <chrono>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::device::inverse3 {

namespace {

using namespace std::chrono_literals;

constexpr net::WebSocketClient::Limits limits{.connect_max = 500ms,
                                              .message_bytes_max = message_bytes_max};
constexpr base::Duration inventory_max = 500ms; // longest wait for the service's list of devices

/// A connection, and the list of devices that the service sends first.
struct Session {
    net::WebSocketClient client;
    ServiceState inventory;
};

Opened<Session> begin_session(std::uint16_t port)
{
    auto client = net::WebSocketClient::connect(port, limits);
    if (!client) {
        return device_error(
            Fault::not_found,
            fmt::format("no Inverse Service answers ({}): install and start the service of Haply "
                        "(haply-inverse-service), or give its port by --inverse3-port",
                        client.error().message));
    }
    const auto first = client->receive(inventory_max);
    if (!first) {
        return device_error(Fault::timeout,
                            fmt::format("port {} does not list its devices within 500 ms: is it "
                                        "the Inverse Service of Haply, 3.1 or newer?",
                                        port));
    }
    auto inventory = parse_state(*first);
    if (!inventory) {
        return device_error(Fault::communication,
                            fmt::format("port {} sends {}: is it the Inverse Service of Haply, "
                                        "3.1 or newer?",
                                        port, inventory.error().message));
    }
    return Session{*std::move(client), *std::move(inventory)};
}

std::optional<DeviceError> reason_against(const DeviceState& device)
{
    if (device.in_use) {
        return device_error(Fault::in_use, fmt::format("Inverse3 {}: another program uses it: end "
                                                       "that one first",
                                                       device.id))
            .value();
    }
    if (!device.plain_axes) {
        return device_error(Fault::internal,
                            fmt::format("Inverse3 {}: its service permutes the axes: set its basis "
                                        "to XYZ, and start again",
                                        device.id))
            .value();
    }
    return std::nullopt;
}

Identity identity_of(const DeviceState& device)
{
    return {.backend = "inverse3",
            .serial = device.id,
            .model = "Haply Inverse3 behind its Inverse Service",
            .note = std::string{never_run}};
}

} // namespace

std::vector<Found> find_inverse3s(std::uint16_t port)
{
    std::vector<Found> found;
    const auto session = begin_session(port);
    if (!session) return found; // no service answers: there is nothing to list
    for (const DeviceState& device : session->inventory.devices) {
        found.push_back({identity_of(device), reason_against(device)});
    }
    return found;
}

Opened<std::unique_ptr<Device>> open_inverse3(const std::string& id, std::uint16_t port)
{
    auto session = begin_session(port);
    if (!session) return tl::unexpected{session.error()};
    const DeviceState* device = session->inventory.find(id);
    if (device == nullptr) {
        return device_error(Fault::not_found,
                            fmt::format("the Inverse Service on port {} knows no Inverse3{}: {}",
                                        port, id.empty() ? "" : " " + id, cure_of_not_found));
    }
    if (auto reason = reason_against(*device)) return tl::unexpected{*std::move(reason)};
    auto exchange = std::make_unique<Inverse3Exchange>(std::move(session->client), device->id);
    std::ignore = exchange->tell({}); // from now on the device is in use
    return std::make_unique<PolledDevice>(std::move(exchange), identity_of(*device),
                                          capabilities());
}

} // namespace hapnet::device::inverse3
