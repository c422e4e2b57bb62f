// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "web/core/gate.hpp"

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstdint>
#include <string_view>

namespace hapnet::web {

using Request = boost::beast::http::request<boost::beast::http::string_body>;
using RequestParser = boost::beast::http::request_parser<boost::beast::http::string_body>;

/// The largest lengths of a request.
struct RequestLimits {
    std::uint32_t header_bytes = 8U << 10;
    std::uint32_t body_bytes = 64U << 10;
};

/// Sets the limits of a parser that has not seen a byte yet. It refuses longer requests.
void limit(RequestParser& parser, const RequestLimits& limits);

/// True if the request asks for a WebSocket.
[[nodiscard]] bool is_upgrade(const Request& request);

/// Returns the properties by which the gate decides, as views into the request. A header that
/// occurs twice counts as missing.
[[nodiscard]] Asked asked_of(const Request& request);

[[nodiscard]] inline std::string_view view(boost::string_view text)
{
    return {text.data(), text.size()};
}

} // namespace hapnet::web
