// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/world.hpp"

#include "proto/base/time.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/interface.hpp"
#include "proto/net/own_network.hpp"
#include "proto/net/packet_socket.hpp"
#include "proto/net/wait.hpp"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <netinet/in.h>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <sstream>
#include <sys/mman.h>
#include <sys/socket.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

/// Returns the command line. The program finds the emulator's network by the process, which has
/// entered it by that time.
std::vector<std::string> words_of(WorldProgram program, const std::string& interface, bool has_ipv6)
{
    const auto process = std::to_string(getpid());
    if (program == WorldProgram::slirp4netns) {
        std::vector<std::string> words{"slirp4netns", "--mtu=1500"};
        if (has_ipv6) words.emplace_back("--enable-ipv6");
        words.insert(words.end(), {process, interface});
        return words;
    }
    std::vector<std::string> words{"pasta", "--foreground", "--quiet"};
    if (has_ipv6) {
        words.insert(words.end(),
                     {"--address", World::address_of_command_v6, "--gateway", World::router_v6});
    } else {
        words.emplace_back("--ipv4-only");
    }
    // The program forwards no port of the machine, and gives the command no address of the machine.
    for (const auto& [option, value] : {std::pair{"--ns-ifname", interface.c_str()},
                                        {"--mtu", "1500"},
                                        {"--address", World::address_of_command},
                                        {"--netmask", "24"},
                                        {"--gateway", World::router},
                                        {"--dns-forward", World::name_server},
                                        {"--tcp-ports", "none"},
                                        {"--udp-ports", "none"},
                                        {"--tcp-ns", "none"},
                                        {"--udp-ns", "none"}}) {
        words.insert(words.end(), {option, value});
    }
    words.push_back(process);
    return words;
}

/// Returns true if this machine has a route to addresses of the internet by IPv6. Sends nothing.
bool has_route_of_ipv6()
{
    sockaddr_in6 anywhere{};
    anywhere.sin6_family = AF_INET6;
    anywhere.sin6_port = htons(9);
    inet_pton(AF_INET6, "2001:db8::1", &anywhere.sin6_addr);
    const int socket = ::socket(AF_INET6, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (socket < 0) return false;
    const bool has_route =
        connect(socket, reinterpret_cast<const sockaddr*>(&anywhere), sizeof anywhere) == 0;
    close(socket);
    return has_route;
}

/// The error that neither program is installed. Its message is the remedy.
class NotInstalled : public std::error_category {
public:
    [[nodiscard]] const char* name() const noexcept override { return "not installed"; }
    [[nodiscard]] std::string message(int /*error*/) const override
    {
        return "install one of them: apt-get install passt slirp4netns";
    }
};

const std::error_category& not_installed()
{
    static const NotInstalled category;
    return category;
}

std::string troubles_text(const std::vector<std::string>& troubles)
{
    return fmt::format("cannot join the command to this machine's network: {}",
                       fmt::join(troubles, "; "));
}

struct Cure {
    std::string text;
    int error = 0; // errno for which this is the remedy
};

/// Returns the remedy for a person, as far as the reason is visible from here.
Cure cure_of_both()
{
    constexpr const char* tun = "/dev/net/tun";
    const int device = ::open(tun, O_RDWR | O_CLOEXEC);
    const int error = device < 0 ? errno : 0;
    if (device >= 0) close(device);
    if (error == EACCES || error == EPERM) {
        return {fmt::format("this user may not open {0}, as on most systems users may: have an "
                            "administrator run chmod 666 {0}",
                            tun),
                error};
    }
    if (error != 0) {
        return {fmt::format("there is no {0}: modprobe tun; in a container, pass it on (with "
                            "Docker: --device {0})",
                            tun),
                error};
    }
    if (geteuid() == 0) {
        return {"pasta does not serve root: apt-get install slirp4netns, or run this as another "
                "user",
                EPERM};
    }
    return {"this machine needs a default route: see 'ip route'; slirp4netns does without",
            ENETUNREACH};
}

/// Asks for the router's address, as the command will do first, until there is an answer. The
/// programs make the interface some time before they serve it.
bool await_answer(const std::string& interface, base::TimePoint deadline)
{
    constexpr std::array<std::uint8_t, 42> question{
        0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 2, 0,  0, 0, 0,   1, 8, 6, 0, 1, 8, 0,  6, 4, 0,
        1,    2,    0,    0,    0,    0,    1, 10, 0, 2, 100, 0, 0, 0, 0, 0, 0, 10, 0, 2, 2};
    constexpr base::Duration again = 100ms;
    net::PacketSocket socket{interface};
    const std::array<std::span<const std::byte>, 1> batch{std::as_bytes(std::span{question})};
    for (auto now = net::monotonic_now(); now < deadline; now = net::monotonic_now()) {
        socket.send_batch(batch);
        for (const auto next = now + again; net::monotonic_now() < next;) {
            net::wait_readable(std::array{socket.descriptor()}, next);
            for (const net::ReceivedFrame& frame : socket.receive()) {
                if (read_frame(frame.bytes).kind == FrameKind::neighbours) return true;
            }
        }
    }
    return false;
}

} // namespace

/// One of the two programs, before and while it runs.
class World::Helper {
public:
    Helper(WorldProgram program, const std::string& interface, bool has_ipv6)
        : program_{program},
          process_{{.words = words_of(program, interface, has_ipv6),
                    .has_own_group = true,
                    .output = output_.descriptor()}}
    {}

    [[nodiscard]] WorldProgram program() const { return program_; }
    [[nodiscard]] net::ChildCommand& process() { return process_; }
    [[nodiscard]] bool is_installed() const { return is_installed_; }

    /// Starts the program, which makes the interface. Returns nullopt when the interface exists,
    /// otherwise an error message.
    std::optional<std::string> open(const std::string& interface)
    {
        constexpr base::Duration patience = 10s;
        try {
            process_.prepare();
            process_.go();
        } catch (const std::system_error& error) {
            is_installed_ = error.code().value() != ENOENT;
            return is_installed_ ? error.what() : "not installed";
        }
        const auto deadline = net::monotonic_now() + patience;
        while (!net::has_interface(interface)) {
            if (const auto code = process_.exit_code()) {
                const auto said = output_.last_line();
                return said.empty() ? fmt::format("it ended with {}", *code) : said;
            }
            const auto now = net::monotonic_now();
            if (now > deadline) {
                process_.signal(SIGKILL);
                return "it made no interface within 10 s";
            }
            net::sleep_until(now + 2ms);
        }
        net::switch_off_offloads(interface);
        net::set_up(interface);
        try {
            if (await_answer(interface, deadline)) return std::nullopt;
        } catch (const std::system_error&) {
            return std::nullopt; // its frames cannot be read; open_session() reports why
        }
        process_.signal(SIGKILL);
        return "it answered nothing within 10 s";
    }

private:
    /// The output of the program, in a file in memory.
    class Output {
    public:
        Output() : descriptor_{memfd_create("output", MFD_CLOEXEC)}
        {
            if (descriptor_ < 0) net::deny_network(errno, "memfd_create");
        }
        ~Output() { close(descriptor_); }
        Output(const Output&) = delete;
        Output& operator=(const Output&) = delete;
        [[nodiscard]] int descriptor() const { return descriptor_; }

        /// Returns its last line; "" when there is none.
        [[nodiscard]] std::string last_line() const
        {
            std::string text(4096, '\0');
            const auto length = pread(descriptor_, text.data(), text.size(), 0);
            std::istringstream lines{
                text.substr(0, length > 0 ? static_cast<std::size_t>(length) : 0)};
            std::string last;
            for (std::string line; std::getline(lines, line);) {
                // pasta also writes to the log of the system, and reports when there is none.
                if (!line.empty() && line.find("to syslog") == std::string::npos) last = line;
            }
            return last;
        }

    private:
        int descriptor_;
    };

    WorldProgram program_;
    Output output_;
    net::ChildCommand process_;
    bool is_installed_ = true;
};

World::World(std::optional<WorldProgram> only, std::string interface)
    : interface_{std::move(interface)}, has_ipv6_{has_route_of_ipv6()}
{
    for (const auto program : {WorldProgram::pasta, WorldProgram::slirp4netns}) {
        if (only && *only != program) continue;
        helpers_.push_back(std::make_unique<Helper>(program, interface_, has_ipv6_));
    }
}

World::~World() = default;

void World::open()
{
    std::vector<std::string> troubles;
    bool is_one_installed = false;
    for (const auto& helper : helpers_) {
        const auto trouble = helper->open(interface_);
        if (!trouble) {
            used_ = helper.get();
            return;
        }
        is_one_installed = is_one_installed || helper->is_installed();
        troubles.push_back(fmt::format("{}: {}", base::name_of(helper->program()), *trouble));
    }
    if (!is_one_installed)
        throw std::system_error{ENOENT, not_installed(), troubles_text(troubles)};
    const auto [cure, error] = cure_of_both();
    net::deny_network(error, fmt::format("{}; {}", troubles_text(troubles), cure));
}

std::string_view World::name() const { return base::name_of(used_->program()); }

net::ChildCommand& World::process() { return used_->process(); }

std::string name_servers_of_world()
{
    std::string text;
    std::ifstream file{"/etc/resolv.conf"};
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("nameserver")) text += line + "\n";
    }
    return text + fmt::format("nameserver {}\n", World::name_server);
}

} // namespace hapnet::emulator
