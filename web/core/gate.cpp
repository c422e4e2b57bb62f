// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/gate.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::web {

namespace {

constexpr std::string_view reading = "GET, HEAD";
constexpr std::string_view posting = "POST";

constexpr std::array routes{
    Route{"/", reading, true},    Route{"/a/", reading, true},     Route{"/metrics", reading, true},
    Route{"/live", "GET", true}, // the page's first message brings the token
    Route{"/f/", reading},        Route{"/api/state", reading},    Route{"/api/history", reading},
    Route{"/api/files", reading}, Route{"/api/emulator", posting}, Route{"/api/stage", posting},
    Route{"/api/pace", posting},  Route{"/api/trap", posting},     Route{"/api/keep", posting},
    Route{"/api/mark", posting},
};

/// True if the text is a number from 0 to 255 in decimal digits, without leading zeros.
bool is_octet(std::string_view text)
{
    if (text.empty() || text.size() > 3 || (text.size() > 1 && text.front() == '0')) return false;
    int value = 0;
    for (const char c : text) {
        if (c < '0' || c > '9') return false;
        value = value * 10 + (c - '0');
    }
    return value <= 255;
}

bool is_loopback_address(std::string_view name)
{
    int octets = 0;
    std::string_view rest = name;
    while (true) {
        const auto dot = rest.find('.');
        const auto octet = rest.substr(0, dot);
        if (!is_octet(octet) || (octets == 0 && octet != "127")) return false;
        ++octets;
        if (dot == std::string_view::npos) return octets == 4;
        rest.remove_prefix(dot + 1);
    }
}

bool is_equal_ignoring_case(std::string_view a, std::string_view b)
{
    return std::ranges::equal(
        a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

bool is_json(std::string_view content_type)
{
    const auto end = content_type.find(';');
    auto kind = content_type.substr(0, end);
    while (!kind.empty() && kind.back() == ' ') kind.remove_suffix(1);
    return is_equal_ignoring_case(kind, "application/json");
}

bool is_method_of(std::string_view method, std::string_view methods)
{
    return method == "HEAD" ? methods == reading
                            : methods == method || (methods == reading && method == "GET");
}

} // namespace

bool is_loopback_name(std::string_view name)
{
    return name == "[::1]" || is_equal_ignoring_case(name, "localhost") ||
           is_loopback_address(name);
}

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

const Route* route_of(std::string_view target)
{
    const auto path = path_of(target);
    const auto found = std::ranges::find_if(routes, [&](const Route& route) {
        const bool is_folder = route.path.size() > 1 && route.path.back() == '/';
        return is_folder ? path.starts_with(route.path) : path == route.path;
    });
    return found == routes.end() ? nullptr : &*found;
}

Gate::Gate(Setup setup) : setup_{std::move(setup)} { base::ensure(!setup_.token.empty()); }

bool Gate::is_token(std::string_view text) const
{
    if (text.size() != setup_.token.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        difference |= static_cast<unsigned char>(text[i] ^ setup_.token[i]);
    }
    return difference == 0;
}

/// True if "name:port" is one of this server's own addresses.
bool Gate::is_own(std::string_view authority) const
{
    if (std::ranges::any_of(setup_.hosts, [&](const std::string& host) {
            return is_equal_ignoring_case(host, authority);
        })) {
        return true;
    }
    // The colon before the port follows the bracket of an IPv6 address.
    const auto bracket = authority.rfind(']');
    const auto colon = authority.find(':', bracket == std::string_view::npos ? 0 : bracket);
    const auto name = authority.substr(0, colon);
    const bool is_port = colon == std::string_view::npos
                             ? setup_.port == 80
                             : authority.substr(colon + 1) == std::to_string(setup_.port);
    return is_port && is_loopback_name(name);
}

bool Gate::is_own_origin(std::string_view origin) const
{
    constexpr std::string_view scheme = "http://";
    constexpr std::string_view sealed = "https://"; // a proxy in front of the server may use it
    if (origin.starts_with(scheme)) return is_own(origin.substr(scheme.size()));
    return origin.starts_with(sealed) &&
           std::ranges::any_of(setup_.hosts, [&](const std::string& host) {
               return is_equal_ignoring_case(host, origin.substr(sealed.size()));
           });
}

/// Refuses a request from a page of another site.
std::optional<Refusal> Gate::refuses_site(const Asked& asked) const
{
    const bool must_say = asked.is_upgrade || asked.method == posting;
    if (must_say && !asked.origin) return Refusal{403, "no Origin: only the page itself may ask"};
    if (asked.origin && !is_own_origin(*asked.origin)) {
        return Refusal{403, "the page of another site may not ask"};
    }
    // A user may follow a link to the page.
    const auto path = path_of(asked.target);
    if (path == "/" || path.starts_with("/a/")) return std::nullopt;
    if (asked.fetch_site && *asked.fetch_site != "same-origin" && *asked.fetch_site != "none") {
        return Refusal{403, "the page of another site may not ask"};
    }
    return std::nullopt;
}

std::optional<Refusal> Gate::refuses(const Asked& asked) const
{
    if (!asked.host || !is_own(*asked.host)) {
        return Refusal{403, fmt::format("this host name is not permitted; use 127.0.0.1:{} or "
                                        "--host NAME",
                                        setup_.port)};
    }
    if (auto site = refuses_site(asked)) return site;
    const Route* route = route_of(asked.target);
    if (route == nullptr) return Refusal{404, "there is no such page"};
    if (!is_method_of(asked.method, route->methods)) {
        return Refusal{405, fmt::format("use {} here", route->methods), route->methods};
    }
    if (route->path == "/live" && !asked.is_upgrade) {
        return Refusal{400, "this is a WebSocket: ask for an upgrade"};
    }
    if (route->path != "/live" && asked.is_upgrade) {
        return Refusal{400, "no WebSocket here: it is at /live"};
    }
    if (!route->is_open && (!asked.token || !is_token(*asked.token))) {
        return Refusal{401, "the token is missing or wrong: open the address that hapnet-web "
                            "printed"};
    }
    if (asked.method == posting && (!asked.content_type || !is_json(*asked.content_type))) {
        return Refusal{415, "send application/json"};
    }
    return std::nullopt;
}

} // namespace hapnet::web
