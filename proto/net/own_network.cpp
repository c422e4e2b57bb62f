// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/own_network.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sched.h>
#include <spdlog/fmt/fmt.h>
#include <sstream>
#include <string_view>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::net {

namespace {

bool write_to(const char* path, std::string_view text)
{
    const int file = open(path, O_WRONLY | O_CLOEXEC);
    if (file < 0) return false;
    const bool is_written = write(file, text.data(), text.size()) == std::ssize(text);
    const int error = errno;
    close(file);
    errno = error;
    return is_written;
}

/// Errors of the system whose text has named the cure.
class NetworkErrors : public std::error_category {
public:
    [[nodiscard]] const char* name() const noexcept override { return "own network"; }
    [[nodiscard]] std::string message(int error) const override
    {
        return std::generic_category().message(error);
    }
};

constexpr std::string_view user_namespace_cure =
    "cannot make a user namespace, which another user than root needs for a network of its own; "
    "the system forbids it: run as root, or have an administrator allow it: sysctl -w "
    "user.max_user_namespaces=10000, on Debian also kernel.unprivileged_userns_clone=1, on Ubuntu "
    "kernel.apparmor_restrict_unprivileged_userns=0; in a container, allow unshare (with Docker: "
    "--security-opt seccomp=unconfined)";

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

/// A socket that tells of the sockets in the network of that process (sock_diag(7)); -1 when it
/// cannot be had. The calling thread is in that network for a moment.
int sockets_of(pid_t process)
{
    const int own = open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
    const int other = open(fmt::format("/proc/{}/ns/net", process).c_str(), O_RDONLY | O_CLOEXEC);
    int sockets = -1;
    if (own >= 0 && other >= 0 && setns(other, CLONE_NEWNET) == 0) {
        sockets = socket(AF_NETLINK, SOCK_DGRAM | SOCK_CLOEXEC, NETLINK_SOCK_DIAG);
        base::ensure(setns(own, CLONE_NEWNET) == 0);
    }
    if (own >= 0) close(own);
    if (other >= 0) close(other);
    return sockets;
}

/// True if there is a socket of this family and protocol in one of the states, each a bit. False,
/// too, where the kernel cannot tell.
bool has_socket(int sockets, int family, int protocol, std::uint32_t states)
{
    struct Request {
        nlmsghdr header{};
        inet_diag_req_v2 wanted{};
    } request;
    request.header.nlmsg_len = sizeof request;
    request.header.nlmsg_type = SOCK_DIAG_BY_FAMILY;
    request.header.nlmsg_flags = NLM_F_REQUEST | NLM_F_DUMP;
    request.wanted.sdiag_family = static_cast<std::uint8_t>(family);
    request.wanted.sdiag_protocol = static_cast<std::uint8_t>(protocol);
    request.wanted.idiag_states = states;
    if (send(sockets, &request, sizeof request, 0) != static_cast<ssize_t>(sizeof request))
        return false;
    bool has = false;
    alignas(nlmsghdr) std::array<char, 8192> answer{};
    while (true) {
        const auto length = recv(sockets, answer.data(), answer.size(), 0);
        if (length < static_cast<ssize_t>(sizeof(nlmsghdr))) return has;
        for (std::size_t at = 0; at + sizeof(nlmsghdr) <= static_cast<std::size_t>(length);) {
            nlmsghdr header{};
            std::memcpy(&header, answer.data() + at, sizeof header);
            if (header.nlmsg_type == NLMSG_DONE || header.nlmsg_type == NLMSG_ERROR) return has;
            has = true;
            at += NLMSG_ALIGN(std::max<std::size_t>(header.nlmsg_len, sizeof header));
        }
    }
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

/// What makes a namespace comfortable; where it is refused, only that is missing.
void open_own_network()
{
    if (unshare(CLONE_NEWNET) != 0) deny_network(errno, "cannot make a network namespace");
    // Addresses are usable at once, and ping works without a capability.
    write_to("/proc/sys/net/ipv6/conf/default/accept_dad", "0");
    write_to("/proc/sys/net/ipv6/conf/all/accept_dad", "0");
    const auto group = std::to_string(getegid());
    write_to("/proc/sys/net/ipv4/ping_group_range", group + " " + group);
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

void deny_network(int error, const std::string& what)
{
    static const NetworkErrors errors;
    throw std::system_error{error, errors, what};
}

void enter_own_network()
{
    if (geteuid() != 0) {
        const auto user = std::to_string(geteuid());
        const auto group = std::to_string(getegid());
        if (unshare(CLONE_NEWUSER) != 0 ||
            !write_to("/proc/self/uid_map", user + " " + user + " 1") ||
            !write_to("/proc/self/setgroups", "deny") ||
            !write_to("/proc/self/gid_map", group + " " + group + " 1")) {
            deny_network(errno, std::string{user_namespace_cure});
        }
    }
    if (unshare(CLONE_NEWNET) != 0) {
        deny_network(errno,
                     "cannot make a network namespace: a container needs CAP_SYS_ADMIN for it "
                     "(with Docker: --cap-add SYS_ADMIN --cap-add NET_ADMIN), or the right to make "
                     "user namespaces and another user than root");
    }
    write_to("/proc/sys/net/ipv6/conf/default/disable_ipv6", "1");
}

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
        if (setup.has_own_network) open_own_network();
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

bool has_listener(pid_t process)
{
    const int sockets = sockets_of(process);
    if (sockets < 0) return false;
    // Those that listen; UDP has no state of its own for a socket that is bound to no other end.
    constexpr std::uint32_t listens = 1U << 10U; // TCP_LISTEN
    constexpr std::uint32_t is_bound = 1U << 7U; // TCP_CLOSE
    const bool has = has_socket(sockets, AF_INET, IPPROTO_TCP, listens) ||
                     has_socket(sockets, AF_INET6, IPPROTO_TCP, listens) ||
                     has_socket(sockets, AF_INET, IPPROTO_UDP, is_bound) ||
                     has_socket(sockets, AF_INET6, IPPROTO_UDP, is_bound);
    close(sockets);
    return has;
}

} // namespace hapnet::net
