// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Commands without namespaces, which every user may start. See also tests/e2e/between.
#include "proto/net/child_command.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <poll.h>
#include <string>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::net::child_command_test {
namespace {

constexpr int patience_ms = 20'000;

/// The file to which these tests' commands write.
struct Output {
    Output() { EXPECT_EQ(pipe(ends.data()), 0); }
    ~Output()
    {
        for (const int end : ends) close(end);
    }
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

    /// The number in the next line.
    [[nodiscard]] pid_t number() const
    {
        std::string line;
        char next = 0;
        while (read(ends[0], &next, 1) == 1 && next != '\n') line += next;
        return std::atoi(line.c_str());
    }

    std::array<int, 2> ends{-1, -1};
};

ChildCommand::Setup shell(const std::string& script, const Output& output)
{
    return {.words = {"sh", "-c", script}, .has_own_group = true, .output = output.ends[1]};
}

void start(ChildCommand& command)
{
    command.prepare();
    command.go();
}

int code_of(ChildCommand& command)
{
    pollfd polled{command.descriptor(), POLLIN, 0};
    EXPECT_EQ(poll(&polled, 1, patience_ms), 1);
    return command.exit_code().value_or(-1);
}

/// True if the process has ended, whether or not its parent has collected it.
bool has_ended(pid_t process)
{
    std::ifstream file{"/proc/" + std::to_string(process) + "/stat"};
    const std::string text{std::istreambuf_iterator<char>{file}, {}};
    const auto name_end = text.rfind(')');
    return name_end == std::string::npos || text.substr(name_end + 2, 1) == "Z";
}

bool comes_to_end(pid_t process)
{
    for (int waited_ms = 0; waited_ms < patience_ms; waited_ms += 10) {
        if (has_ended(process)) return true;
        poll(nullptr, 0, 10);
    }
    return false;
}

/// In a session of its own, so that no signal to the command's group reaches it.
constexpr const char* leaves_one_behind = "setsid sleep 1000 & echo $!; exit 5";

TEST(ChildCommand, GivesTheExitCodeOrTheSignal)
{
    const Output output;
    for (const auto& [script, code] :
         {std::pair{"exit 7", 7}, std::pair{"kill -KILL $$", 128 + SIGKILL}}) {
        ChildCommand command{shell(script, output)};
        start(command);
        EXPECT_EQ(code_of(command), code);
    }
}

TEST(ChildCommand, PassesASignalOnToItsGroup)
{
    const Output output;
    ChildCommand command{shell("trap 'exit 9' TERM; echo 1; while :; do sleep 0.05; done", output)};
    start(command);
    EXPECT_EQ(output.number(), 1);
    EXPECT_FALSE(command.exit_code());
    command.signal(SIGTERM);
    EXPECT_EQ(code_of(command), 9);
    command.signal(SIGTERM); // reaches no process
}

TEST(ChildCommand, LetsWhatWasLeftBehindLiveUntilItEndsItself)
{
    const Output output;
    pid_t behind = 0;
    {
        ChildCommand command{shell(leaves_one_behind, output)};
        start(command);
        behind = output.number();
        EXPECT_EQ(code_of(command), 5);
        EXPECT_FALSE(has_ended(behind)) << "a daemon plays on when the command that made it ends";
    }
    EXPECT_TRUE(has_ended(behind));
}

TEST(ChildCommand, LeavesNothingOfAProgramThatIsKilled)
{
    const Output output;
    const pid_t program = fork();
    if (program == 0) {
        ChildCommand command{shell("setsid sh -c 'sleep 1000 & echo $!; wait' & "
                                   "setsid sleep 1000 & echo $!; echo $$; wait",
                                   output)};
        start(command);
        while (true) pause();
    }
    std::array<pid_t, 3> left{};
    for (pid_t& process : left) process = output.number();
    kill(program, SIGKILL);
    waitpid(program, nullptr, 0);
    for (const pid_t process : left) EXPECT_TRUE(comes_to_end(process)) << process;
}

TEST(ChildCommand, LeavesNothingOfACommandWhoseInitIsKilled)
{
    const Output output;
    ChildCommand command{shell("echo $$; sleep 1000", output)};
    start(command);
    const pid_t process = output.number();
    kill(command.pid(), SIGKILL);
    EXPECT_EQ(code_of(command), 128 + SIGKILL);
    EXPECT_TRUE(comes_to_end(process));
}

TEST(ChildCommand, NamesACommandThatDoesNotExist)
{
    ChildCommand command{{.words = {"/no/such/command"}}};
    command.prepare();
    try {
        command.go();
        ADD_FAILURE() << "it runs";
    } catch (const std::system_error& error) {
        EXPECT_EQ(error.code().value(), ENOENT);
        EXPECT_NE(std::string{error.what()}.find("cannot run /no/such/command"), std::string::npos);
    }
}

TEST(ChildCommand, ThrowsWhatItsPreparationFailedOf)
{
    ChildCommand command{{.words = {"true"}, .prepare = [] {
                              throw std::system_error{ENODEV, std::generic_category(), "no wire"};
                          }}};
    EXPECT_THROW(command.prepare(), std::system_error);
}

} // namespace
} // namespace hapnet::net::child_command_test
