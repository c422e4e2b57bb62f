// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz_target.hpp"
#include "web/core/feed.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

/// For any lines from daemons, pages get JSON with an entry for each peer, and the history is JSON.
/// Every figure for traps is a finite number with an announced name.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    using Json = nlohmann::json;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    web::Feed feed;
    feed.set_peers({{1, "a"}, {2, "a"}, {3, "b"}});
    std::istringstream lines{text};
    std::size_t place = 0;
    for (std::string line; std::getline(lines, line); place = (place + 1) % feed.peers().size()) {
        if (auto frame = web::parse_peer_frame(line)) feed.take_peer(place, std::move(*frame));
        if (auto frame = web::parse_emulator_frame(line)) feed.take_emulator(std::move(*frame));
        if (line.empty()) feed.lose_peer(place);
        const auto live = feed.next(1.0, base::TimePoint{std::chrono::seconds{1}});
        if (!live) continue;
        const Json json = Json::parse("{\"n\":1" + *live, nullptr, /*allow_exceptions*/ false);
        base::ensure(json.is_object() && json["peers"].size() == feed.peers().size());
        const auto names = feed.names();
        for (const auto& [name, value] : feed.figures()) {
            base::ensure(std::isfinite(value));
            base::ensure(std::ranges::find(names, name) != names.end());
        }
    }
    base::ensure(Json::accept(feed.history().fine_json()));
    base::ensure(Json::accept(feed.history().coarse_json()));
    return 0;
}
