// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/connection.hpp"
#include "ctl/options.hpp"
#include "ctl/print.hpp"
#include "ctl/request.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/standard_streams.hpp"
#include "proto/net/stop_signal.hpp"

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace hapnet::ctl {

namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

constexpr std::string_view program = "hapnet-ctl";

/// The longest wait for an answer, which usually takes milliseconds.
constexpr base::Duration answer_max = 10s;

/// Returns the exit code that belongs to an answer.
int exit_code(const Json& reply)
{
    if (reply.value("ok", false)) return reply.value("met", true) ? 0 : net::exit_failed;
    return reply.value("busy", false) ? net::exit_environment : net::exit_usage;
}

/// Prints one answer and returns its exit code.
int print(const std::string& line, const Options& options, WatchPrinter& watch)
{
    const auto reply = Json::parse(line, nullptr, /*allow_exceptions*/ false);
    if (!reply.is_object()) {
        net::say(program,
                 fmt::format("{} does not speak hapnet's control protocol: name the --control "
                             "of an emulator or a peer",
                             options.socket));
        return net::exit_environment;
    }
    const int code = exit_code(reply);
    if (options.as_json) {
        net::print(line + "\n");
    } else if (!reply.value("ok", false)) {
        net::say(program, reply.value("error", "refused"));
    } else if (options.of_frames) {
        net::print(line + "\n");
    } else if (options.command == "watch") {
        net::print(watch.next(reply));
    } else {
        net::print(in_words(options, reply));
    }
    net::require_stdout();
    return code;
}

/// Returns the deadline of an answer; nullopt if it may take any time.
std::optional<base::TimePoint> answer_deadline(const Options& options)
{
    if (options.command == "watch") return std::nullopt;
    const auto now = net::monotonic_now();
    if (options.command != "wait") return now + answer_max;
    if (!options.timeout) return std::nullopt;
    return now + *options.timeout + answer_max;
}

/// Reports why there is no further answer. Returns the exit code.
int say_why(Connection::State state, const Options& options)
{
    switch (state) {
    case Connection::State::good: return 0;
    case Connection::State::stopped: return options.command == "watch" ? 0 : net::exit_failed;
    case Connection::State::closed:
        net::say(program, "the program has ended or closed the connection");
        return net::exit_failed;
    case Connection::State::late:
        net::say(program, "the program does not answer");
        return net::exit_failed;
    }
    return net::exit_failed;
}

int converse(Connection& connection, const Json& request, const Options& options)
{
    const auto text = request.dump(-1, ' ', false, Json::error_handler_t::replace);
    auto state = connection.send(text, net::monotonic_now() + answer_max);
    WatchPrinter watch{isatty(STDOUT_FILENO) != 0};
    while (state == Connection::State::good) {
        state = connection.receive(answer_deadline(options));
        if (state != Connection::State::good) break;
        const int code = print(connection.line(), options, watch);
        if (options.command != "watch" || code != 0) return code;
    }
    return say_why(state, options);
}

base::Result<int> control(const Options& options)
{
    const auto request = make_request(options);
    if (!request) return tl::unexpected{request.error()};
    net::StopSignal stop;
    std::optional<Connection> connection;
    try {
        connection.emplace(options.socket, stop);
    } catch (const std::system_error& error) {
        net::say(program, net::explained_connection(error));
        return net::exit_environment;
    }
    return converse(*connection, *request, options);
}

} // namespace

int main_program(std::span<char*> words)
{
    return net::run_program(program, parse_options(words, std::getenv("HAPNET_SOCKET")), control);
}

} // namespace hapnet::ctl

int main(int argc, char** argv)
{
    hapnet::net::fill_standard_streams();
    return hapnet::ctl::main_program({argv, static_cast<std::size_t>(argc)});
}
