// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/endpoint.hpp"

#include <vector>

namespace hapnet::net {

/// Tells when this machine loses an address that sockets are bound to, as with the interface that
/// had it, and when the address is back. A socket alone does not show it: nothing arrives any more.
class AddressWatch {
public:
    /// The addresses of the sockets; one that stands for all addresses is never lost. Where the
    /// system does not tell of its addresses (AF_NETLINK is forbidden) there is no news.
    explicit AddressWatch(const std::vector<Endpoint>& locals);
    ~AddressWatch();
    AddressWatch(const AddressWatch&) = delete;
    AddressWatch& operator=(const AddressWatch&) = delete;

    /// Readable when addresses of this machine have changed; -1: the system does not tell.
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
