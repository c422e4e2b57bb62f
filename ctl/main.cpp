// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/connection.hpp"
#include "ctl/options.hpp"
#include "ctl/print.hpp"
#include "proto/base/text.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/stop_signal.hpp"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

constexpr std::string_view program = "hapnet-ctl";

/// How long an answer may take; it takes milliseconds.
constexpr base::Duration answer_max = 10s;

std::string_view cure_of(int error)
{
    switch (error) {
    case ENOENT:
    case ECONNREFUSED: return "start the emulator or the peer with --control and this path";
    case EACCES: return "only the user who started the program may control it";
    default: return "is this the --control of an emulator or a peer?";
    }
}

base::Result<std::string> text_of(const std::string& file)
{
    if (file == "-") return std::string{std::istreambuf_iterator<char>{std::cin}, {}};
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) {
        return base::fail(fmt::format("{} is a folder: name a profile", file));
    }
    std::ifstream stream{file, std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{stream}, {}};
    if (!stream.is_open() || stream.bad()) {
        return base::fail(fmt::format("cannot read {}: is there such a file?", file));
    }
    return text;
}

base::Result<Json> request_of(const CtlOptions& options)
{
    Json request{{"command", options.command}};
    const auto add = [&](const char* key, const std::optional<std::string>& text) {
        if (text) request[key] = *text;
    };
    for (const auto& [key, value] : options.settings) request["settings"][key] = value;
    if (!options.file.empty()) {
        auto text = text_of(options.file);
        if (!text) return tl::unexpected{text.error()};
        request["profile"] = *std::move(text);
        // What a profile names lies beside it, wherever the emulator was started.
        request["file"] = options.file == "-" ? "(standard input)"
                                              : std::filesystem::absolute(options.file).string();
    }
    if (!options.until.empty()) request["until"] = options.until;
    add("for", options.lasting);
    add("timeout", options.timeout);
    add("every", options.every);
    return request;
}

/// What an answer means for the exit code.
int code_of(const Json& reply)
{
    if (reply.value("ok", false)) return reply.value("met", true) ? 0 : net::exit_failed;
    return reply.value("busy", false) ? net::exit_environment : net::exit_usage;
}

/// Prints one answer; returns the exit code that it stands for.
int print(const std::string& line, const CtlOptions& options, WatchPrinter& watch)
{
    const auto reply = Json::parse(line, nullptr, /*allow_exceptions*/ false);
    if (!reply.is_object()) {
        net::say(program,
                 fmt::format("{} does not speak hapnet's control protocol", options.socket));
        return net::exit_environment;
    }
    const int code = code_of(reply);
    if (options.as_json) {
        fmt::print("{}\n", line);
    } else if (!reply.value("ok", false)) {
        net::say(program, reply.value("error", "refused"));
    } else if (options.command == "watch") {
        fmt::print("{}", watch.next(reply));
    } else {
        fmt::print("{}", in_words(options.command, reply));
    }
    net::require_stdout();
    return code;
}

/// Until when an answer must be there; nullopt for those that may take any time.
std::optional<base::TimePoint> deadline_of(const CtlOptions& options)
{
    if (options.command == "watch") return std::nullopt;
    const auto now = net::monotonic_now();
    if (options.command != "wait") return now + answer_max;
    if (!options.timeout) return std::nullopt;
    return now + base::parse_duration(*options.timeout).value() + answer_max;
}

int trouble(Connection::State state, const CtlOptions& options)
{
    switch (state) {
    case Connection::State::good: return 0;
    case Connection::State::stopped: return options.command == "watch" ? 0 : net::exit_failed;
    case Connection::State::closed:
        net::say(program, "the program has ended, or broken the connection off");
        return net::exit_failed;
    case Connection::State::late:
        net::say(program, "the program does not answer");
        return net::exit_failed;
    }
    return net::exit_failed;
}

int converse(Connection& connection, const Json& request, const CtlOptions& options)
{
    const auto text = request.dump(-1, ' ', false, Json::error_handler_t::replace);
    auto state = connection.send(text, net::monotonic_now() + answer_max);
    WatchPrinter watch{isatty(STDOUT_FILENO) != 0};
    while (state == Connection::State::good) {
        state = connection.receive(deadline_of(options));
        if (state != Connection::State::good) break;
        const int code = print(connection.line(), options, watch);
        if (options.command != "watch" || code != 0) return code;
    }
    return trouble(state, options);
}

base::Result<int> control(const CtlOptions& options)
{
    const auto request = request_of(options);
    if (!request) return tl::unexpected{request.error()};
    net::StopSignal stop;
    std::optional<Connection> connection;
    try {
        connection.emplace(options.socket, stop);
    } catch (const std::system_error& error) {
        net::say(program, fmt::format("{}; {}", error.what(), cure_of(error.code().value())));
        return net::exit_environment;
    }
    return converse(*connection, *request, options);
}

} // namespace

int main_program(std::span<char*> words)
{
    return net::run_program(program, parse_ctl_options(words), control);
}

} // namespace hapnet::emulator

int main(int argc, char** argv)
{
    return hapnet::emulator::main_program({argv, static_cast<std::size_t>(argc)});
}
