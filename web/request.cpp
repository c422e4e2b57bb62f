// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/request.hpp"

#include <iterator>
#include <optional>

namespace hapnet::web {

namespace {

/// Returns nullopt when the header is missing, or occurs twice.
std::optional<std::string_view> header_of(const Request& request, std::string_view name)
{
    const auto [first, last] = request.equal_range(boost::string_view{name.data(), name.size()});
    if (first == last || std::next(first) != last) return std::nullopt;
    return view(first->value());
}

} // namespace

void limit(RequestParser& parser, const RequestLimits& limits)
{
    parser.header_limit(limits.header_bytes);
    parser.body_limit(limits.body_bytes);
}

bool is_upgrade(const Request& request)
{
    return boost::beast::iequals(request[boost::beast::http::field::upgrade], "websocket");
}

Asked asked_of(const Request& request)
{
    return {.method = view(request.method_string()),
            .target = view(request.target()),
            .host = header_of(request, "Host"),
            .origin = header_of(request, "Origin"),
            .fetch_site = header_of(request, "Sec-Fetch-Site"),
            .content_type = header_of(request, "Content-Type"),
            .token = header_of(request, "X-Hapnet-Token"),
            .is_upgrade = is_upgrade(request)};
}

} // namespace hapnet::web
