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

/// A text to print on stdout instead of running: --help, --version.
struct Answer {
    std::string text;
};

/// A command line as it was understood; the error says what is wrong with it and how to mend it.
template <typename Options>
using CommandLine = base::Result<std::variant<Options, Answer>>;

/// Returns the answer for `said`, a text to print or an error, when the program does not run.
[[nodiscard]] inline tl::expected<Answer, base::Error>
answer_of(base::Result<std::optional<std::string>> said)
{
    if (!said) return tl::unexpected{said.error()};
    return Answer{**std::move(said)};
}

/// Writes text for a person to stderr. A closed or full stderr is not an error: it must not end a
/// session.
inline void tell(const std::string& text)
{
    std::ignore = std::fwrite(text.data(), 1, text.size(), stderr);
}

/// Writes a line with the name of the program to stderr: "hapnet-peer: ...".
inline void say(std::string_view program, std::string_view text)
{
    tell(fmt::format("{}: {}\n", program, base::visible_lines(text)));
}

/// Text for a person, on stdout. Names in it may come from a file or another program.
inline void print(std::string_view text) { fmt::print("{}", base::visible_lines(text)); }

/// Throws std::system_error when what was printed could not be written: a full disk, say.
inline void require_stdout()
{
    if (std::fflush(stdout) != 0)
        throw std::system_error{errno, std::generic_category(), "cannot write the output"};
    // An earlier attempt failed, and its reason is gone.
    if (std::ferror(stdout) != 0)
        throw std::system_error{EIO, std::generic_category(), "cannot write the output"};
}

/// Prints a text that a reader waits for, without buffering. Throws std::system_error as above.
inline void print_now(std::string_view text)
{
    fmt::print("{}", text);
    require_stdout();
}

/// The life of every program: prints what is to be printed, runs, and turns each kind of trouble
/// into a message and an exit code. `run` takes the Options and gives a base::Result<int>: its own
/// exit code, or what was bad input.
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
