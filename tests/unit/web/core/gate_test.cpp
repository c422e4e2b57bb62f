// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Requests that are admitted: docs/formats/live.md. 0 stands for "admitted".
#include "web/core/gate.hpp"

#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::web {
namespace {

constexpr std::string_view token = "0123456789abcdef0123456789abcdef";
constexpr std::string_view own = "http://127.0.0.1:8460";

Gate gate() { return Gate{{8460, {"lab.example:8460"}, std::string{token}}}; }

int verdict(const Asked& asked)
{
    const auto refusal = gate().refuses(asked);
    return refusal ? refusal->status : 0;
}

Asked get(std::string_view target)
{
    Asked asked{.method = "GET", .target = target};
    asked.host = "127.0.0.1:8460";
    asked.token = token;
    return asked;
}

Asked post(std::string_view target)
{
    Asked asked = get(target);
    asked.method = "POST";
    asked.origin = own;
    asked.content_type = "application/json";
    return asked;
}

TEST(WebGate, TakesItsOwnHostNamesOnly)
{
    for (const std::string_view host :
         {"127.0.0.1:8460", "127.0.0.2:8460", "127.255.255.255:8460", "[::1]:8460",
          "localhost:8460", "LOCALHOST:8460", "lab.example:8460", "Lab.Example:8460"}) {
        Asked asked = get("/api/state");
        asked.host = host;
        EXPECT_EQ(verdict(asked), 0) << host;
    }
    for (const std::string_view host : {"",
                                        ":8460",
                                        "127.0.0.1",
                                        "127.0.0.1:",
                                        "127.0.0.1:80",
                                        "127.0.0.1:84600",
                                        "127.0.0.1:8460 ",
                                        "127.evil.com:8460",
                                        "127.0.0.1.evil.com:8460",
                                        "127.0.0.256:8460",
                                        "127.0.0.01:8460",
                                        "127.0.0:8460",
                                        "127.0.0.1.:8460",
                                        "127.1:8460",
                                        "128.0.0.1:8460",
                                        "0.0.0.0:8460",
                                        "2130706433:8460",
                                        "0x7f000001:8460",
                                        "localhost.:8460",
                                        "localhost.evil.com:8460",
                                        "notlocalhost:8460",
                                        "[::1]",
                                        "[::]:8460",
                                        "::1:8460",
                                        "[::1]evil.com:8460",
                                        "[::ffff:127.0.0.1]:8460",
                                        "lab.example",
                                        "lab.example:80",
                                        "a.lab.example:8460",
                                        "evil.com:8460",
                                        "evil@127.0.0.1:8460"}) {
        Asked asked = get("/api/state");
        asked.host = host;
        EXPECT_EQ(verdict(asked), 403) << host;
    }
    Asked without = get("/");
    without.host.reset();
    EXPECT_EQ(verdict(without), 403);
}

TEST(WebGate, TakesItsOwnOriginsOnly)
{
    for (const std::string_view origin :
         {"http://127.0.0.1:8460", "http://localhost:8460", "http://[::1]:8460",
          "http://lab.example:8460", "https://lab.example:8460"}) {
        Asked asked = post("/api/stage");
        asked.origin = origin;
        EXPECT_EQ(verdict(asked), 0) << origin;
    }
    for (const std::string_view origin :
         {"", "null", "127.0.0.1:8460", "http://127.0.0.1", "http://127.0.0.1:81",
          "https://127.0.0.1:8460", "file://127.0.0.1:8460", "http://evil.com",
          "http://evil.com:8460", "http://127.0.0.1:8460/", "http://127.0.0.1:8460.evil.com"}) {
        Asked asked = post("/api/stage");
        asked.origin = origin;
        EXPECT_EQ(verdict(asked), 403) << origin;
        Asked reading = get("/api/state");
        reading.origin = origin;
        EXPECT_EQ(verdict(reading), 403) << origin;
    }
    Asked without = post("/api/stage");
    without.origin.reset();
    EXPECT_EQ(verdict(without), 403);
}

TEST(WebGate, WantsTheTokenWhereThereIsSomethingToSeeOrDo)
{
    std::string nearly{token};
    nearly.back() = 'e';
    for (const std::string_view target : {"/api/state", "/api/history", "/api/files", "/f/0"}) {
        Asked asked = get(target);
        EXPECT_EQ(verdict(asked), 0) << target;
        asked.token.reset();
        EXPECT_EQ(verdict(asked), 401) << target;
        for (const std::string& wrong :
             {std::string{}, nearly, std::string{token.substr(1)}, std::string{token} + "0"}) {
            asked.token = wrong;
            EXPECT_EQ(verdict(asked), 401) << target << ' ' << wrong;
        }
    }
    for (const std::string_view target : {"/", "/a/0/app.js", "/metrics"}) {
        Asked asked = get(target);
        asked.token.reset();
        EXPECT_EQ(verdict(asked), 0) << target;
    }
}

TEST(WebGate, WantsJsonAndTheRightMethodAndPath)
{
    Asked asked = post("/api/emulator");
    for (const std::string_view type : {"application/json", "application/json; charset=utf-8"}) {
        asked.content_type = type;
        EXPECT_EQ(verdict(asked), 0) << type;
    }
    for (const std::string_view type : {"", "text/plain", "application/jsonp"}) {
        asked.content_type = type;
        EXPECT_EQ(verdict(asked), 415) << type;
    }
    asked.content_type.reset();
    EXPECT_EQ(verdict(asked), 415);
    EXPECT_EQ(verdict(get("/api/stage")), 405);
    EXPECT_EQ(verdict(post("/api/state")), 405);
    EXPECT_EQ(verdict(get("/api/states")), 404);
    EXPECT_EQ(verdict(get("/live")), 400);
}

TEST(WebGate, LetsNoOtherSiteOpenTheLiveSocket)
{
    Asked asked = get("/live");
    asked.is_upgrade = true;
    EXPECT_EQ(verdict(asked), 403); // no Origin
    asked.origin = own;
    EXPECT_EQ(verdict(asked), 0);
    asked.fetch_site = "cross-site";
    EXPECT_EQ(verdict(asked), 403);
}

} // namespace
} // namespace hapnet::web
