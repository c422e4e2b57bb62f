// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/command_init.hpp"

#include "proto/net/own_network.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <dirent.h>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <poll.h>
#include <sched.h>
#include <spdlog/fmt/fmt.h>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <system_error>
#include <tuple>
#include <unistd.h>
#include <vector>

namespace hapnet::net {

namespace {

constexpr const char* init_name = "hapnet-init"; // name in the output of ps

std::string text_of_system_file(const std::string& path)
{
    const std::ifstream file{path};
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// A folder in memory that only this mount namespace has. Its files stay valid after they were
/// mounted over others. Unlinked files could not be used: no other file can be mounted over them,
/// and another emulator within the command needs that.
class FolderInMemory {
public:
    FolderInMemory()
    {
        if (mkdtemp(path_.data()) == nullptr) deny_network(errno, "cannot write to /tmp");
        constexpr unsigned long flags = MS_NOSUID | MS_NODEV | MS_NOEXEC;
        if (mount("none", path_.c_str(), "tmpfs", flags, "mode=0755") == 0) return;
        const int error = errno;
        rmdir(path_.c_str());
        deny_network(error, "cannot make a folder in memory for the names of hosts");
    }
    ~FolderInMemory()
    {
        umount2(path_.c_str(), MNT_DETACH);
        rmdir(path_.c_str());
    }
    FolderInMemory(const FolderInMemory&) = delete;
    FolderInMemory& operator=(const FolderInMemory&) = delete;

    /// Replaces the content of a file for this mount namespace only.
    void put_over(const char* place, const std::string& text)
    {
        const auto name = fmt::format("{}/{}", path_, ++files_);
        const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        const bool is_written =
            file >= 0 && write(file, text.data(), text.size()) == std::ssize(text) &&
            fchmod(file, 0644) == 0 && mount(name.c_str(), place, nullptr, MS_BIND, nullptr) == 0;
        const int error = errno;
        if (file >= 0) close(file);
        if (!is_written) {
            deny_network(error, fmt::format("cannot give the command its own {}", place));
        }
    }

private:
    std::string path_ = "/tmp/hapnet-XXXXXX";
    int files_ = 0;
};

bool enter_own_mounts()
{
    return unshare(CLONE_NEWNS) == 0 &&
           mount("none", "/", nullptr, MS_REC | MS_SLAVE, nullptr) == 0;
}

/// Restores the default handling of signals that the program has blocked or ignored for itself.
void reset_signals()
{
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    for (const int number : {SIGPIPE, SIGTTIN, SIGTTOU, SIGINT, SIGTERM, SIGHUP}) {
        std::signal(number, SIG_DFL);
    }
}

/// Returns the parent of a process from /proc/PID/stat. It is after the name, which may contain any
/// characters.
pid_t parent_of(std::string_view process)
{
    const auto text = text_of_system_file(fmt::format("/proc/{}/stat", process));
    const auto name_end = text.rfind(')');
    if (name_end == std::string::npos || name_end + 4 >= text.size()) return 0;
    pid_t parent = 0;
    std::from_chars(text.data() + name_end + 4, text.data() + text.size(), parent);
    return parent;
}

std::vector<pid_t> children_of_this_process()
{
    std::vector<pid_t> children;
    DIR* const all = opendir("/proc");
    if (all == nullptr) return children;
    while (const dirent* entry = readdir(all)) {
        const std::string_view name = entry->d_name;
        pid_t process = 0;
        std::from_chars(name.data(), name.data() + name.size(), process);
        if (process > 0 && parent_of(name) == getpid()) children.push_back(process);
    }
    closedir(all);
    return children;
}

/// Kills the descendants of a subreaper. Children of a process that has ended become its own
/// children, and are killed in the next round. Gives up after 2 s, because it may not be allowed to
/// kill a process, such as one of another user.
void kill_descendants()
{
    constexpr int rounds = 200;
    constexpr int pause_ms = 10;
    for (int i = 0; i < rounds; ++i) {
        for (const pid_t child : children_of_this_process()) kill(child, SIGKILL);
        pid_t reaped = 0;
        do {
            reaped = waitpid(-1, nullptr, WNOHANG);
        } while (reaped > 0);
        if (reaped < 0) return; // no child is left
        poll(nullptr, 0, pause_ms);
    }
}

class CommandInit {
public:
    CommandInit(const ChildCommand::Setup& setup, const InitEnds& ends, bool is_first)
        : setup_{setup}, ends_{ends}, is_first_{is_first}
    {}

    [[noreturn]] void live()
    {
        // Keys of the terminal and signals to the group also reach the command, which handles them.
        sigset_t all;
        sigfillset(&all);
        sigprocmask(SIG_SETMASK, &all, nullptr);
        std::signal(SIGCHLD, SIG_DFL); // if it were ignored, there would be no exit codes
        prctl(PR_SET_NAME, init_name);
        if (is_first_) {
            // This also works while this process is stopped. A subreaper must live on to kill the
            // others.
            prctl(PR_SET_PDEATHSIG, SIGKILL);
        } else {
            prctl(PR_SET_CHILD_SUBREAPER, 1);
        }
        if (!take_step([this] { return settle(); })) _exit(1);
        while (true) serve();
    }

private:
    /// Enters its namespaces. Returns false if there is no usable PID namespace.
    bool settle()
    {
        constexpr unsigned long proc_flags = MS_NOSUID | MS_NODEV | MS_NOEXEC;
        if (is_first_) {
            has_own_mounts_ = enter_own_mounts();
            if (!has_own_mounts_ || mount("proc", "/proc", "proc", proc_flags, nullptr) != 0) {
                return false;
            }
        }
        if (setup_.has_own_network) open_command_network();
        return true;
    }

    /// Reports the result of a step. Returns false if it failed.
    template <typename Step>
    bool take_step(Step step) const
    {
        InitReport report;
        try {
            if (!step()) report.kind = InitReport::Kind::refused;
        } catch (const std::system_error& error) {
            // what() has the reason at its end, which the receiver adds again.
            std::string_view what = error.what();
            const auto reason = ": " + error.code().message();
            if (what.ends_with(reason)) what.remove_suffix(reason.size());
            report.kind = InitReport::Kind::failed;
            report.error = error.code().value();
            what.copy(report.what.data(), report.what.size() - 1);
        }
        std::ignore = send(ends_.orders, &report, sizeof report, MSG_NOSIGNAL);
        return report.kind == InitReport::Kind::done;
    }

    /// Waits for an order, the end of a child, or the end of the program.
    void serve()
    {
        std::array<pollfd, 3> polled{
            {{ends_.orders, POLLIN, 0}, {child_ended_, POLLIN, 0}, {ends_.parent, POLLIN, 0}}};
        if (poll(polled.data(), polled.size(), -1) < 0) return;
        if (polled[2].revents != 0) end();
        if (polled[1].revents != 0) reap();
        if (polled[0].revents == 0) return;
        InitOrder order;
        if (recv(ends_.orders, &order, sizeof order, 0) != static_cast<ssize_t>(sizeof order))
            end();
        switch (order.kind) {
        case InitOrder::Kind::prepare:
            if (!take_step([this] { return prepare(); })) _exit(1);
            break;
        case InitOrder::Kind::go:
            if (!take_step([this] { return start(); })) _exit(1);
            break;
        case InitOrder::Kind::signal: pass_on(order.number); break;
        case InitOrder::Kind::end: end();
        }
    }

    bool prepare()
    {
        if (setup_.prepare) setup_.prepare();
        if (setup_.hosts.empty() && setup_.name_servers.empty()) return true;
        if (!has_own_mounts_ && !enter_own_mounts()) {
            deny_network(errno, "cannot give the command its own names of hosts");
        }
        FolderInMemory folder;
        if (!setup_.hosts.empty() && access("/etc/hosts", F_OK) == 0) {
            folder.put_over("/etc/hosts", text_of_system_file("/etc/hosts") + "\n" + setup_.hosts);
        }
        if (!setup_.name_servers.empty() && access("/etc/resolv.conf", F_OK) == 0) {
            folder.put_over("/etc/resolv.conf", setup_.name_servers);
        }
        return true;
    }

    /// Starts the command, and returns true once it runs.
    bool start()
    {
        sigset_t child;
        sigemptyset(&child);
        sigaddset(&child, SIGCHLD);
        child_ended_ = signalfd(-1, &child, SFD_CLOEXEC | SFD_NONBLOCK);
        std::array<int, 2> failure{-1, -1}; // closed by exec(), or receives an errno
        if (child_ended_ < 0 || pipe2(failure.data(), O_CLOEXEC) != 0) deny_network(errno, "pipe");
        command_ = fork();
        if (command_ < 0) deny_network(errno, "fork");
        if (command_ == 0) become_command(failure[1]);
        // The child does the same, because either may be first.
        if (setup_.has_own_group) setpgid(command_, command_);
        close(failure[1]);
        int error = 0;
        const bool has_failed = read(failure[0], &error, sizeof error) == sizeof error;
        close(failure[0]);
        if (!has_failed) return true;
        deny_network(error, fmt::format("cannot run {}: check its spelling, or give its path",
                                        setup_.words.front()));
    }

    [[noreturn]] void become_command(int failure) const
    {
        if (setup_.has_own_group) {
            setpgid(0, 0);
            const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
            dup2(nothing, STDIN_FILENO);
        }
        if (!is_first_) prctl(PR_SET_PDEATHSIG, SIGKILL); // in case the subreaper is killed
        reset_signals();
        if (setup_.output >= 0) {
            dup2(setup_.output, STDOUT_FILENO);
            dup2(setup_.output, STDERR_FILENO);
        }
        for (const std::string& variable : setup_.environment) {
            const auto equals = variable.find('=');
            setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
        }
        std::vector<char*> words;
        for (const std::string& word : setup_.words) {
            words.push_back(const_cast<char*>(word.c_str())); // NOLINT: execvp writes none
        }
        words.push_back(nullptr);
        execvp(words.front(), words.data());
        const int error = errno;
        std::ignore = write(failure, &error, sizeof error);
        _exit(127);
    }

    /// Reaps the command, and every process that has lost its own parent.
    void reap()
    {
        signalfd_siginfo ignored{};
        while (read(child_ended_, &ignored, sizeof ignored) > 0) {}
        int status = 0;
        while (true) {
            const pid_t child = waitpid(-1, &status, WNOHANG);
            if (child <= 0) return;
            if (child != command_ || has_command_ended_) continue;
            has_command_ended_ = true;
            const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
            std::ignore = write(ends_.ended, &code, sizeof code);
        }
    }

    void pass_on(int number) const
    {
        if (command_ < 0) return;
        if (setup_.has_own_group) {
            kill(-command_, number);
        } else if (!has_command_ended_) {
            kill(command_, number);
        }
    }

    [[noreturn]] void end() const
    {
        if (!is_first_) kill_descendants();
        _exit(0); // the kernel kills the rest of a PID namespace
    }

    const ChildCommand::Setup& setup_;
    InitEnds ends_;
    bool is_first_;
    bool has_own_mounts_ = false;
    int child_ended_ = -1;
    pid_t command_ = -1;
    bool has_command_ended_ = false;
};

} // namespace

void live_as_init(const ChildCommand::Setup& setup, const InitEnds& ends, bool is_first)
{
    CommandInit{setup, ends, is_first}.live();
}

} // namespace hapnet::net
