// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/e2e/emulator.hpp"

#include "tests/e2e/udp.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>

namespace hapnet::e2e {

using namespace std::chrono_literals;

Emulator::Emulator(const std::vector<std::string>& options, std::string_view host)
{
    std::vector<std::string> words{"--listen-a", std::string{host},
                                   "--listen-b", std::string{host},
                                   "--stats",    folder_.file("stats.json")};
    words.insert(words.end(), options.begin(), options.end());
    process_.emplace("hapnet-emulator", words);
    const auto ready = process_->wait_for_out("ready ", 10s);
    if (!ready) throw std::runtime_error{"the emulator is not ready: " + process_->err()};
    a_ = endpoint_in(*ready, "a");
    b_ = endpoint_in(*ready, "b");
}

nlohmann::json Emulator::stop() { return stop(SIGTERM); }

nlohmann::json Emulator::stop(int signal_number)
{
    process_->signal(signal_number);
    EXPECT_EQ(process_->wait_exit(10s), 0) << process_->err();
    auto statistics =
        nlohmann::json::parse(text_of(folder_.file("stats.json")), nullptr, /*exceptions*/ false);
    EXPECT_TRUE(statistics.is_object());
    if (!statistics.is_object()) return {};
    expect_identity(statistics["up"]);
    expect_identity(statistics["down"]);
    return statistics;
}

std::string said_by(const std::string& socket, std::string_view text)
{
    auto stream = net::UnixStream::connect(socket);
    while (!text.empty()) {
        const auto sent = stream.write(text);
        if (sent.state == net::Transfer::State::gone) break;
        text.remove_prefix(sent.bytes);
        std::this_thread::sleep_for(1ms);
    }
    return heard(stream);
}

std::string heard(net::UnixStream& stream)
{
    std::string text;
    std::array<char, 4096> buffer{};
    for (int i = 0; i < 5000 && text.find('\n') == std::string::npos; ++i) {
        const auto taken = stream.read(buffer);
        if (taken.state == net::Transfer::State::moved) {
            text.append(buffer.data(), taken.bytes);
        } else if (taken.state != net::Transfer::State::later) {
            break;
        } else {
            std::this_thread::sleep_for(1ms);
        }
    }
    return text;
}

void expect_identity(const nlohmann::json& direction)
{
    std::uint64_t dropped = 0;
    for (const auto& count : direction["dropped"]) dropped += count.get<std::uint64_t>();
    EXPECT_EQ(direction["received"].get<std::uint64_t>() +
                  direction["duplicated"].get<std::uint64_t>(),
              direction["delivered"].get<std::uint64_t>() + dropped +
                  direction["in_flight"].get<std::uint64_t>())
        << direction;
}

} // namespace hapnet::e2e
