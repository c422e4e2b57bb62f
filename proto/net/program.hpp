// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/visible.hpp"
#include "proto/net/cure.hpp"
#include "proto/net/exit_guard.hpp"
#include "proto/net/file_limit.hpp"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <variant>

namespace hapnet::net {

/// Exit codes, the same in all programs.
inline constexpr int exit_failed = 1;      // the run failed
inline constexpr int exit_usage = 2;       // bad usage or bad input
inline constexpr int exit_environment = 3; // the system refused a request

/// A text that is printed on stdout instead of running: --help, --version.
struct Answer {
    std::string text;
};

/// A parsed command line. The error says what is wrong with it and how to correct it.
template <typename Options>
using CommandLine = base::Result<std::variant<Options, Answer>>;

/// Converts the result of a parser for the case that the program does not run: a text to print, or
/// an error.
[[nodiscard]] inline tl::expected<Answer, base::Error>
answer_of(base::Result<std::optional<std::string>> said)
{
    if (!said) return tl::unexpected{said.error()};
    return Answer{**std::move(said)};
}

/// Writes text for people to stderr. A closed or full stderr is not an error, as it must not end a
/// session.
inline void tell(const std::string& text)
{
    std::ignore = std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Writes a line to stderr that begins with the name of the program: "hapnet-peer: ...".
inline void say(std::string_view program, std::string_view text)
{
    tell(fmt::format("{}: {}\n", program, base::visible_lines(text)));
}

/// Prints text for people on stdout. Control characters are made visible, because names in the text
/// may come from a file or another program.
inline void print(std::string_view text) { fmt::print("{}", base::visible_lines(text)); }

/// Throws std::system_error if the output could not be written, because of a full disk for example.
inline void require_stdout()
{
    if (std::fflush(stdout) != 0)
        throw std::system_error{errno, std::generic_category(), "cannot write the output"};
    // The reason is unknown, because an earlier write failed.
    if (std::ferror(stdout) != 0)
        throw std::system_error{EIO, std::generic_category(), "cannot write the output"};
}

/// Prints a text without buffering, for a reader that waits for it. Throws std::system_error like
/// require_stdout().
inline void print_now(std::string_view text)
{
    fmt::print("{}", text);
    require_stdout();
}

/// Runs a program from its command line to its exit code: prints the text of an Answer, or calls
/// `run`, and turns each kind of error into a message and an exit code. `run` takes the Options and
/// returns a base::Result<int>: its own exit code, or an error for bad input.
template <typename Options, typename Run>
[[nodiscard]] int run_program(std::string_view program, const CommandLine<Options>& line, Run run)
{
    const ExitGuard guard{program};
    survive_file_limit();
    try {
        if (!line) {
            say(program, line.error().message);
            return exit_usage;
        }
        if (const auto* answer = std::get_if<Answer>(&*line)) {
            fmt::print("{}", answer->text);
            require_stdout();
            return 0;
        }
        const base::Result<int> code = run(std::get<Options>(*line));
        if (!code) say(program, code.error().message);
        require_stdout();
        return code.value_or(exit_usage);
    } catch (const std::system_error& error) {
        say(program, explained(error));
        return exit_environment;
    } catch (const std::bad_alloc&) {
        say(program, "out of memory: this machine has too little for what was asked");
        return exit_environment;
    } catch (const std::exception& error) {
        say(program, error.what());
        return exit_failed;
    }
}

} // namespace hapnet::net
