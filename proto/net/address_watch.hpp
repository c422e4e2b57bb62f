// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/endpoint.hpp"

#include <vector>

namespace hapnet::net {

/// Reports when this machine loses an address that sockets are bound to, as it does with the
/// address's interface, and when the address is back. The socket itself does not show the loss: it
/// only receives nothing more.
class AddressWatch {
public:
    /// Watches the addresses of these sockets. A wildcard address is never lost. There is no news
    /// if the system does not report address changes (AF_NETLINK is forbidden).
    explicit AddressWatch(const std::vector<Endpoint>& locals);
    ~AddressWatch();
    AddressWatch(const AddressWatch&) = delete;
    AddressWatch& operator=(const AddressWatch&) = delete;

    /// Readable when addresses of this machine have changed; -1: the system does not report
    /// changes.
    [[nodiscard]] int descriptor() const { return socket_; }

    struct News {
        Endpoint local; // endpoint of the first socket that has the address
        bool is_lost = false;
    };
    /// Returns the changes since the last call. Never blocks.
    [[nodiscard]] std::vector<News> news();

private:
    struct Address {
        Endpoint local;
        bool is_lost = false;
    };

    int socket_ = -1;
    std::vector<Address> watched_;
};

} // namespace hapnet::net
