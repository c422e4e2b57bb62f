// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/e2e/peer.hpp"

#include "tests/e2e/udp.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace hapnet::e2e {

using namespace std::chrono_literals;

std::string free_place() { return Host{}.endpoint().to_text(); }

Peer::Peer(int id, std::string listen, std::string remote, std::vector<std::string> options)
    : words_{"--id",     std::to_string(id), "--listen", std::move(listen),
             "--remote", std::move(remote)}
{
    words_.insert(words_.end(), options.begin(), options.end());
    words_.insert(words_.end(),
                  {"--record", folder_.file("run.rec"), "--stats", folder_.file("run.json")});
    start();
}

void Peer::start()
{
    process_.emplace("hapnet-peer", words_);
    const auto ready = process_->wait_for_out("ready ", 10s);
    if (!ready) throw std::runtime_error{"the peer is not ready: " + process_->err()};
}

bool Peer::says(std::string_view words)
{
    const bool said = process_->wait_for_err(words, 20s).has_value();
    EXPECT_TRUE(said) << "expected: " << words << "\nbut said:\n" << process_->err();
    return said;
}

void Peer::kill()
{
    process_->signal(SIGKILL);
    EXPECT_EQ(process_->wait_exit(5s), 128 + SIGKILL);
}

void Peer::restart() { start(); }

void Peer::expect_end() { EXPECT_EQ(process_->wait_exit(30s), 0) << process_->err(); }

void Peer::stop()
{
    process_->signal(SIGTERM);
    expect_end();
}

void Peer::stop_on_a_busy_machine()
{
    process_->signal(SIGTERM);
    const auto exit = process_->wait_exit(30s);
    const auto fault = statistics()["governor"]["fault"];
    EXPECT_TRUE(fault == "none" || fault == "timeout") << fault;
    EXPECT_EQ(exit, fault == "none" ? 0 : 1) << process_->err();
}

nlohmann::json Peer::statistics() const
{
    auto json =
        nlohmann::json::parse(text_of(folder_.file("run.json")), nullptr, /*exceptions*/ false);
    EXPECT_TRUE(json.is_object());
    return json.is_object() ? json : nlohmann::json::object();
}

nlohmann::json answer_of(const std::string& socket, const std::string& command)
{
    const Outcome outcome = run("hapnet-ctl", {socket, "--json", command});
    auto answer = nlohmann::json::parse(outcome.out, nullptr, /*exceptions*/ false);
    EXPECT_TRUE(answer.is_object()) << outcome.out << outcome.err;
    return answer.is_object() ? answer : nlohmann::json::object();
}

void expect_to_hear(const std::string& socket, int messages)
{
    EXPECT_TRUE(comes_true(
        [&] { return answer_of(socket, "stats")["messages"]["states_received"] >= messages; }));
}

std::string fault_at(const std::string& socket)
{
    return answer_of(socket, "stats").value(nlohmann::json::json_pointer{"/governor/fault"}, "");
}

namespace {

std::vector<std::string> cells_of(const std::string& line)
{
    std::istringstream stream{line};
    std::vector<std::string> cells;
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
}

} // namespace

std::vector<Tick> ticks_of(const std::string& record)
{
    const Outcome exported = run("hapnet-lab", {"export", "--csv", record}, 30s);
    EXPECT_EQ(exported.exit, 0) << exported.err;
    std::istringstream lines{exported.out};
    std::string line;
    std::getline(lines, line);
    const auto header = cells_of(line);
    const auto column = [&](std::string_view name) {
        const auto found = std::find(header.begin(), header.end(), name);
        EXPECT_NE(found, header.end()) << name;
        return static_cast<std::size_t>(found - header.begin());
    };
    const auto time = column("time_s");
    const auto phase = column("phase");
    const auto fresh = column("remote_fresh");
    const auto force = column("device_x_n");
    const auto hip = column("hip_x_mm");
    const auto docked = column("docked");
    std::vector<Tick> ticks;
    while (std::getline(lines, line)) {
        const auto cells = cells_of(line);
        if (cells.size() != header.size()) continue;
        ticks.push_back(
            {std::stod(cells[time]),
             cells[phase],
             cells[fresh] == "1",
             std::hypot(std::stod(cells[force]), std::stod(cells[force + 1]),
                        std::stod(cells[force + 2])),
             {std::stod(cells[hip]), std::stod(cells[hip + 1]), std::stod(cells[hip + 2])},
             cells[docked] == "1"});
    }
    return ticks;
}

nlohmann::json expect_the_same_forces_again(const std::string& record)
{
    const Outcome replayed = run("hapnet-lab", {"replay", record, "--json"}, 30s);
    EXPECT_EQ(replayed.exit, 0) << replayed.err;
    auto json = nlohmann::json::parse(replayed.out, nullptr, /*exceptions*/ false);
    EXPECT_TRUE(json.is_object()) << replayed.out;
    if (!json.is_object()) return nlohmann::json::object();
    EXPECT_LE(json["contact_difference_max_n"], 1e-9);
    EXPECT_LE(json["device_difference_max_n"], 1e-9);
    EXPECT_GT(json["messages"], 100);
    return json;
}

nlohmann::json analysis_of(const std::string& record_a, const std::string& record_b)
{
    const Outcome analysed = run("hapnet-lab", {"analyse", record_a, record_b, "--json"}, 30s);
    EXPECT_EQ(analysed.exit, 0) << analysed.err;
    auto json = nlohmann::json::parse(analysed.out, nullptr, /*exceptions*/ false);
    EXPECT_TRUE(json.is_object()) << analysed.out;
    return json.is_object() ? json : nlohmann::json::object();
}

} // namespace hapnet::e2e
