// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/disk/private_file.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/service_manager.hpp"
#include "proto/net/standard_streams.hpp"
#include "proto/net/stop_signal.hpp"
#include "web/core/gate.hpp"
#include "web/core/stage_plan.hpp"
#include "web/hub.hpp"
#include "web/options.hpp"
#include "web/presets.hpp"
#include "web/server.hpp"

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::web {

namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

constexpr std::string_view program_name = "hapnet-web";
constexpr int ports_tried = 20;
constexpr int niceness = 10; // the loops of the daemons take precedence
constexpr std::size_t token_digits_least = 32;
constexpr std::size_t token_file_bytes_max = 4096;

base::Result<std::string> token_of(const Options& options)
{
    if (options.token_file.empty()) {
        return fmt::format("{:016x}{:016x}", net::unpredictable_bits(), net::unpredictable_bits());
    }
    // In a volume with secrets the files are links (Kubernetes).
    auto text =
        disk::read_private(options.token_file, {.name = "token file",
                                                .bytes_max = token_file_bytes_max,
                                                .links = disk::PrivateKind::Links::followed});
    if (!text) return text;
    while (!text->empty() && std::isspace(static_cast<unsigned char>(text->back())) != 0) {
        text->pop_back();
    }
    const bool are_digits =
        std::ranges::all_of(*text, [](unsigned char c) { return std::isxdigit(c) != 0; });
    if (text->size() < token_digits_least || !are_digits) {
        return base::fail(options.token_file +
                          ": expected 32 or more hexadecimal digits, as from openssl rand -hex 16");
    }
    return text;
}

/// Returns a socket that listens at this address; nullopt when the port is taken.
std::optional<tcp::acceptor> listening(asio::io_context& io, const tcp::endpoint& at)
{
    boost::system::error_code error;
    tcp::acceptor acceptor{io};
    acceptor.open(at.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address{true}, error);
    if (!error && at.protocol() == tcp::v6()) {
        acceptor.set_option(asio::ip::v6_only{true}, error);
    }
    if (!error) acceptor.bind(at, error);
    if (!error) acceptor.listen(64, error);
    if (error == asio::error::address_in_use) return std::nullopt;
    if (error) {
        throw std::system_error{error.value(), net::errors_of(net::AddressUse::bind),
                                fmt::format("listen at {}", at.address().to_string())};
    }
    return acceptor;
}

/// Listens at the chosen port, or at the next free one.
tcp::acceptor listening_on_loopback(asio::io_context& io, const Options& options)
{
    const int tries = options.is_port_chosen ? 1 : ports_tried;
    for (int i = 0; i < tries; ++i) {
        const auto port = static_cast<unsigned short>(options.port + i);
        if (auto acceptor = listening(io, {asio::ip::address_v4::loopback(), port})) {
            if (i > 0) {
                net::say(program_name,
                         fmt::format("port {} is taken: {} instead", options.port, port));
            }
            return std::move(*acceptor);
        }
    }
    throw std::system_error{EADDRINUSE, net::errors_of(net::AddressUse::bind),
                            fmt::format("listen at 127.0.0.1:{}", options.port)};
}

/// Also listens at ::1, if this machine has it, and at --listen, if it was given. Throws
/// std::system_error when it cannot listen at --listen.
void listen_besides(asio::io_context& io, const Options& options, std::uint16_t port,
                    Server& server)
{
    try {
        if (auto six = listening(io, {asio::ip::address_v6::loopback(), port})) {
            server.accept_from(std::move(*six));
        }
    } catch (const std::system_error&) {
        // A machine without IPv6: 127.0.0.1 is enough.
    }
    if (options.listen.empty()) return;
    boost::system::error_code error;
    const auto address = asio::ip::make_address(options.listen, error);
    if (error) {
        throw std::system_error{EINVAL, std::generic_category(),
                                "--listen " + options.listen + ": not an address"};
    }
    auto acceptor = listening(io, {address, port});
    if (!acceptor) {
        throw std::system_error{EADDRINUSE, net::errors_of(net::AddressUse::bind),
                                "--listen " + options.listen};
    }
    server.accept_from(std::move(*acceptor));
    net::say(program_name, fmt::format("{}:{} speaks plain HTTP: whoever sees the traffic has the "
                                       "token; ssh -L is safer",
                                       options.listen, port));
}

/// Returns the folder of this program and of the others beside it.
std::string own_folder()
{
    return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

std::string results_folder(const Options& options)
{
    if (!options.out.empty()) return std::filesystem::absolute(options.out).string();
    const auto now = static_cast<long long>(net::wall_clock_seconds());
    return std::filesystem::absolute(fmt::format("results/web-{}", now)).string();
}

Stage::Setup stage_setup(const Options& options)
{
    std::vector<std::string> names;
    for (const Preset& preset : presets_built_in()) names.emplace_back(preset.name);
    return {.programs = own_folder(),
            .out = results_folder(options),
            .choices = all_choices(std::move(names))};
}

/// Ticks until a signal arrives, and notifies the service manager.
class Heart {
public:
    Heart(asio::io_context& io, Hub& hub, const net::StopSignal& stop, net::ServiceManager& manager)
        : io_{io},
          hub_{hub},
          timer_{io},
          stop_{stop},
          manager_{manager},
          signal_{io, dup(stop.descriptor())}
    {
        signal_.async_wait(asio::posix::stream_descriptor::wait_read,
                           [this](const boost::system::error_code&) { io_.stop(); });
        beat();
    }

private:
    void beat()
    {
        timer_.expires_after(Hub::frame_every - late_);
        const auto due = net::monotonic_now() + (Hub::frame_every - late_);
        timer_.async_wait([this, due](const boost::system::error_code& error) {
            if (error) return;
            const auto now = net::monotonic_now();
            late_ = std::clamp(now - due, base::Duration{0}, Hub::frame_every / 2);
            hub_.tick(now);
            manager_.tell_alive(now);
            if (stop_.requested()) return io_.stop();
            beat();
        });
    }

    asio::io_context& io_;
    Hub& hub_;
    asio::steady_timer timer_;
    const net::StopSignal& stop_;
    net::ServiceManager& manager_;
    asio::posix::stream_descriptor signal_;
    base::Duration late_{}; // delay of the last beat, subtracted from the next
};

base::Result<int> run(const Options& options)
{
    const net::StopSignal stop; // made before any thread starts
    net::ServiceManager manager;
    std::signal(SIGPIPE, SIG_IGN);
    const auto token = token_of(options);
    if (!token) return tl::unexpected{token.error()};
    asio::io_context io{1};
    auto acceptor = listening_on_loopback(io, options);
    const std::uint16_t port = acceptor.local_endpoint().port();
    Hub hub{io};
    if (options.stage) hub.offer(stage_setup(options), !options.keeps_stopped, options.is_virtual);
    setpriority(PRIO_PROCESS, 0, niceness); // this thread only: another thread starts children
    if (!options.lab.empty()) {
        hub.attach_lab(options.lab);
    } else if (!options.stage) {
        hub.attach(options.emulator, options.peers);
    }
    const Gate gate{{.port = port, .hosts = options.hosts, .token = *token}};
    const Page page;
    Server server{{io, hub, gate, page}};
    server.accept_from(std::move(acceptor));
    listen_besides(io, options, port, server);
    const std::string url = fmt::format("http://127.0.0.1:{}/#t={}", port, *token);
    if (!options.url_file.empty())
        disk::ResultFile{options.url_file, "--url-file", 0600}.commit(url + "\n");
    net::print_now(fmt::format("open {}\n", url));
    manager.tell_ready();
    Heart heart{io, hub, stop, manager};
    io.run();
    manager.tell_stopping();
    return 0;
}

} // namespace

int main_program(std::span<char*> words)
{
    return net::run_program(program_name, parse_options(words), run);
}

} // namespace hapnet::web

int main(int argc, char** argv)
{
    hapnet::net::fill_standard_streams();
    return hapnet::web::main_program({argv, static_cast<std::size_t>(argc)});
}
