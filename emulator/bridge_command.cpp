// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/core/profile/flows.hpp"
#include "emulator/frame_session.hpp"
#include "emulator/scenario.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/interface.hpp"
#include "proto/net/program.hpp"
#include "proto/net/stop_signal.hpp"

#include <array>
#include <cerrno>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <system_error>

namespace hapnet::emulator {

namespace {

/// Makes an interface pass on frames as they arrived, and restores its settings in the destructor.
class PlainReception {
public:
    explicit PlainReception(const std::string& interface)
        : interface_{interface}, before_{net::receive_offloads_of(interface)}
    {
        if (before_ != 0) net::set_receive_offloads(interface_, 0);
    }
    ~PlainReception()
    {
        if (before_ != 0) net::set_receive_offloads(interface_, before_);
    }
    PlainReception(const PlainReception&) = delete;
    PlainReception& operator=(const PlainReception&) = delete;

private:
    std::string interface_;
    std::uint32_t before_;
};

base::Result<int> relay_frames(const BridgeOptions& options, const Scenario& scenario)
{
    const net::StopSignal stop{net::Hangup::stop};
    FrameSession session{options.run,
                         scenario,
                         {.command = "bridge",
                          .frames = {.ends = {{"a", options.a}, {"b", options.b}},
                                     .all_frames = options.frames.all_frames,
                                     .fix_checksums = options.frames.fix_checksums,
                                     .stops_at_loop = true,
                                     .answers_too_big = options.frames.answers_too_big}}};
    const PlainReception plain_a{options.a};
    const PlainReception plain_b{options.b};
    if (const auto fine = session.ensure_checks(); !fine) return tl::unexpected{fine.error()};
    session.announce();
    net::print_now(fmt::format("ready a={} b={} seed={} timing={}\n", options.a, options.b,
                               scenario.seed.value(), base::name_of(options.run.timing)));
    const std::array descriptors{stop.descriptor()};
    auto now = net::monotonic_now();
    while (!stop.requested() && !session.is_stopped() && !session.failure() &&
           !base::is_due(session.end(), now)) {
        now = session.turn(descriptors, session.end());
    }
    return session.finish() ? 0 : net::exit_failed;
}

} // namespace

base::Result<int> run(const BridgeOptions& options)
{
    const auto scenario = scenario_of(options.run);
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto fits = validate_for_frames(scenario->profile.flows, options.frames.all_frames);
    if (!fits) return tl::unexpected{fits.error()};
    try {
        return relay_frames(options, *scenario);
    } catch (const std::system_error& error) {
        const int code = error.code().value();
        const bool is_denied = code == EPERM || code == EACCES;
        if (!is_denied && code != ENODEV) throw;
        net::say("hapnet-emulator",
                 fmt::format("{}; {}", error.what(),
                             is_denied ? "a bridge needs CAP_NET_RAW: run it as root, or give it "
                                         "to the program: setcap cap_net_raw,cap_net_admin+ep "
                                         "FILE. Without it, 'hapnet-emulator between' works"
                                       : "'ip link' lists the interfaces"));
        return net::exit_environment;
    }
}

} // namespace hapnet::emulator
