// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/request.hpp"

#include "tests/fuzz/fuzz_target.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/error.hpp>
#include <string>
#include <string_view>

/// For any bytes from a client, the server's parser and gate give a verdict. An admitted client has
/// named one host and its port, is of no other site, and has the token wherever it is needed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    static constexpr std::string_view token = "00112233445566778899aabbccddeeff";
    static const web::Gate gate{{8460, {"lab.example:8460"}, std::string{token}}};
    web::RequestParser parser;
    web::limit(parser, {});
    parser.eager(true);
    boost::beast::error_code error;
    for (std::size_t used = 0, taken = 1; !parser.is_done() && !error && taken > 0; used += taken) {
        taken = parser.put(boost::asio::buffer(data + used, size - used), error);
    }
    if (error || !parser.is_done()) return 0;
    const web::Request request = parser.release();
    base::ensure(request.body().size() <= web::RequestLimits{}.body_bytes);
    const web::Asked asked = web::asked_of(request);
    if (const auto refusal = gate.refuses(asked)) {
        base::ensure(refusal->status >= 400 && refusal->status < 500 && !refusal->error.empty());
        return 0;
    }
    const bool is_posted = request.method() == boost::beast::http::verb::post;
    base::ensure(request.count("Host") == 1 && asked.host->ends_with(":8460"));
    base::ensure(request.count("Origin") == 1 || (!is_posted && !asked.is_upgrade));
    base::ensure(!asked.origin || asked.origin->ends_with(":8460"));
    const bool wants_token = asked.target.starts_with("/api/") || asked.target.starts_with("/f/");
    base::ensure(!wants_token || asked.token == token);
    return 0;
}
