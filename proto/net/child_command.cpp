// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/child_command.hpp"

#include "proto/net/own_network.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sched.h>
#include <spdlog/fmt/fmt.h>
#include <sstream>
#include <string_view>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::net {

namespace {

std::string text_of_system_file(const std::string& path)
{
    const std::ifstream file{path};
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Puts a text in the place of a file, for this mount namespace alone.
void put_over(const char* place, const std::string& text)
{
    std::string name = "/tmp/hapnet-XXXXXX";
    const int file = mkostemp(name.data(), O_CLOEXEC);
    if (file < 0) deny_network(errno, "cannot write to /tmp");
    const bool is_written = write(file, text.data(), text.size()) == std::ssize(text);
    fchmod(file, 0644);
    close(file);
    const int mounted = is_written ? mount(name.c_str(), place, nullptr, MS_BIND, nullptr) : -1;
    const int error = errno;
    unlink(name.c_str());
    if (mounted != 0) deny_network(error, fmt::format("cannot give the command its own {}", place));
}

void put_names(const ChildCommand::Setup& setup)
{
    if (setup.hosts.empty() && setup.name_servers.empty()) return;
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_SLAVE, nullptr) != 0) {
        deny_network(errno, "cannot give the command its own names of hosts");
    }
    if (!setup.hosts.empty() && access("/etc/hosts", F_OK) == 0) {
        put_over("/etc/hosts", text_of_system_file("/etc/hosts") + "\n" + setup.hosts);
    }
    if (!setup.name_servers.empty() && access("/etc/resolv.conf", F_OK) == 0) {
        put_over("/etc/resolv.conf", setup.name_servers);
    }
}

/// The default again for what this process has blocked or ignored for itself.
void reset_signals()
{
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    for (const int number : {SIGPIPE, SIGTTIN, SIGTTOU, SIGINT, SIGTERM, SIGHUP}) {
        std::signal(number, SIG_DFL);
    }
}

void send_report(int reports, int error, std::string_view what)
{
    std::string text(sizeof error, '\0');
    std::memcpy(text.data(), &error, sizeof error);
    text += what.substr(0, 512);
    const auto written = write(reports, text.data(), text.size());
    static_cast<void>(written); // whoever reads it has gone
}

/// Waits for the byte of the next step; this process ends when there will be none.
void await_order(int orders)
{
    char byte = 0;
    if (read(orders, &byte, 1) != 1) _exit(0);
}

std::array<int, 2> make_pipe()
{
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) deny_network(errno, "pipe");
    return ends;
}

} // namespace

ChildCommand::ChildCommand(const Setup& setup) : has_own_group_{setup.has_own_group}
{
    const auto orders = make_pipe();
    const auto reports = make_pipe();
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ < 0) deny_network(errno, "fork");
    if (pid_ == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != parent) _exit(1);
        close(orders[1]);
        close(reports[0]);
        be_child(setup, orders[0], reports[1]);
    }
    close(orders[0]);
    close(reports[1]);
    orders_ = orders[1];
    reports_ = reports[0];
    ended_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
    if (ended_ < 0) deny_network(errno, "pidfd_open");
    await_report();
}

void ChildCommand::be_child(const Setup& setup, int orders, int reports) const
{
    try {
        if (has_own_group_) {
            setpgid(0, 0);
            const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
            dup2(nothing, STDIN_FILENO);
        }
        if (setup.has_own_network) open_command_network();
        send_report(reports, 0, "");
        await_order(orders);
        if (setup.prepare) setup.prepare();
        put_names(setup);
        send_report(reports, 0, "");
        await_order(orders);
        reset_signals();
        if (setup.output >= 0) {
            dup2(setup.output, STDOUT_FILENO);
            dup2(setup.output, STDERR_FILENO);
        }
        for (const std::string& variable : setup.environment) {
            const auto equals = variable.find('=');
            setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
        }
        std::vector<char*> words;
        for (const std::string& word : setup.words) {
            words.push_back(const_cast<char*>(word.c_str())); // NOLINT: execvp writes none
        }
        words.push_back(nullptr);
        execvp(words.front(), words.data());
        send_report(reports, errno,
                    fmt::format("cannot run {}: check its spelling, or give its path",
                                setup.words.front()));
    } catch (const std::system_error& error) {
        // what() of it has the reason at its end, which is added again.
        std::string_view what = error.what();
        const auto reason = ": " + error.code().message();
        if (what.ends_with(reason)) what.remove_suffix(reason.size());
        send_report(reports, error.code().value(), what);
    }
    _exit(127);
}

/// Throws what failed. Nothing more comes once the command runs.
void ChildCommand::await_report()
{
    std::array<char, 1024> text{};
    const auto count = read(reports_, text.data(), text.size());
    if (count < static_cast<ssize_t>(sizeof(int))) return;
    int error = 0;
    std::memcpy(&error, text.data(), sizeof error);
    if (error == 0) return;
    deny_network(error, std::string{text.data() + sizeof error,
                                    static_cast<std::size_t>(count) - sizeof error});
}

void ChildCommand::prepare()
{
    if (write(orders_, "p", 1) != 1) deny_network(errno, "the child process has ended");
    await_report();
}

void ChildCommand::go()
{
    if (write(orders_, "g", 1) != 1) deny_network(errno, "the child process has ended");
    await_report();
}

std::optional<int> ChildCommand::exit_code()
{
    if (exit_code_ || pid_ < 0) return exit_code_;
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) != pid_) return std::nullopt;
    exit_code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return exit_code_;
}

void ChildCommand::signal(int number)
{
    if (exit_code() && !has_own_group_) return;
    kill(has_own_group_ ? -pid_ : pid_, number);
}

ChildCommand::~ChildCommand()
{
    if (pid_ >= 0) {
        signal(SIGKILL);
        if (!exit_code_) waitpid(pid_, nullptr, 0);
    }
    for (const int descriptor : {ended_, orders_, reports_}) {
        if (descriptor >= 0) close(descriptor);
    }
}

} // namespace hapnet::net
