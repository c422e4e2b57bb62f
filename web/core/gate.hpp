// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::web {

/// The properties of a request that decide whether it is admitted. nullopt: the request has no such
/// header.
struct Asked {
    std::string_view method; // "GET"
    std::string_view target; // "/api/state", with its query
    std::optional<std::string_view> host{};
    std::optional<std::string_view> origin{};
    std::optional<std::string_view> fetch_site{}; // Sec-Fetch-Site
    std::optional<std::string_view> content_type{};
    std::optional<std::string_view> token{}; // X-Hapnet-Token
    bool is_upgrade = false;                 // asks to become a WebSocket
};

/// The reason why a request is refused.
struct Refusal {
    int status = 403;
    std::string error;        // a sentence for a person
    std::string_view allow{}; // for status 405: the methods that work
};

/// Decides which requests are admitted: docs/use/web.md. Any website can make the user's browser
/// send requests to the page's address, so only host, origin and token count.
class Gate {
public:
    struct Setup {
        std::uint16_t port = 0;
        std::vector<std::string> hosts{}; // besides loopback: "lab.example:8460", as typed
        std::string token;                // in hexadecimal digits, not empty
    };

    explicit Gate(Setup setup);

    /// Returns the refusal of a request; nullopt: it is admitted.
    [[nodiscard]] std::optional<Refusal> refuses(const Asked& asked) const;

    /// True if the text is the token. The time of the comparison depends on the length alone.
    [[nodiscard]] bool is_token(std::string_view text) const;

private:
    [[nodiscard]] bool is_own(std::string_view authority) const;
    [[nodiscard]] bool is_own_origin(std::string_view origin) const;
    [[nodiscard]] std::optional<Refusal> refuses_site(const Asked& asked) const;

    Setup setup_;
};

/// A path of the server, with its methods, and if it needs the token.
struct Route {
    std::string_view path;    // a path that ends with '/' includes all paths below it
    std::string_view methods; // "GET, HEAD"
    bool is_open = false;     // needs no token
};

/// Returns the route of a target; nullptr: there is no such path. `target` may have a query.
[[nodiscard]] const Route* route_of(std::string_view target);

/// Returns a target without its query.
[[nodiscard]] std::string_view path_of(std::string_view target);

/// True if the name denotes this machine: "localhost", "[::1]", or any address of 127.0.0.0/8, each
/// without a port. A name that merely begins with such an address is not accepted.
[[nodiscard]] bool is_loopback_name(std::string_view name);

} // namespace hapnet::web
