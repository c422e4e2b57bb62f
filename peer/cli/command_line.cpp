// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/command_line.hpp"

#include "peer/cli/schemas.hpp"
#include "peer/doctor/findings.hpp"
#include "proto/cli/command.hpp"
#include "proto/cli/parsers.hpp"

#include <utility>

namespace hapnet::peer {

namespace {

constexpr const char* description =
    "One of two to eight peers that push the same virtual cube and feel each other through it: a "
    "1 kHz haptic loop with its own copy of the scene, a device, and 1000 messages a second to "
    "each other peer, directly or through hapnet-emulator.";

constexpr const char* footer =
    R"(Tasks of the hands (docs/design/tasks.md; the lower --id is L and pushes from the left):
  P1  L holds the cube and carries it along a prescribed path, R watches (the paper's Table 1)
  T1  in turn: L pushes the cube where the path rises, R where it falls
  T2  one holds the cube, the other presses against it at 0.5, 1 and 2 Hz; then they swap
  T3  both squeeze the cube between them and carry it along the path at half speed
  T4  both squeeze the cube, lift it by 50 mm, hold it for 5 s and put it down
  T5  both press the cube against the static one; in turn one lets go suddenly
  T6  L taps the cube at 3 Hz while R rests on its far side
  T7  T3 with two to eight hands: by their ids the 1st, 3rd, ... act as L, the others as R
  T8  two to eight hands turn the cube of the scene turning to and fro; sides as in T7
  T9  L puts a cube of stack-of-three on another, then R the third on both; others watch
  T10 L hands R the bench's screwdriver, and R puts it down; others watch
Each task ends with 3 s hands off, within --duration (half of it when that is below 6s). All peers
need the same task and scene; the shortest --duration counts, from their common start. A peer waits
for the others without a limit.

Algorithms (docs/design/algorithms.md; two peers may use different ones):
  base            the paper's: forces add up where both push; where one does, the other follows
  dead-reckoning  the same, with the other peer's cube extrapolated to now
  sep             the same, with the other hand's force and position predicted
                  (in place of the paper's TiDeC, which is not published)
  remote-proxy    not of the paper: the other hand is in this scene, drawn to where it means to be
  base-tdpa       base, with damping where the other side's force brings in more than its work
  wave            the copies are joined by a channel of waves; passive, and soft over a delay
  couple          the copies are joined by springs within their energy; passive, and soft
  lag             all copies play equally late: they agree, and touch is late and soft
  rollback        computes the present anew from an exact past with each message; to compare
A FILE sets their parameters; --print-algorithm dead-reckoning prints one to start from. FILE.so is
a shared object with an algorithm of your own (docs/use/libraries.md).

Examples:
  hapnet-peer --id 1 --listen :7101 --remote 127.0.0.1:7102 --task T3
  hapnet-peer --id 2 --listen :7102 --remote 127.0.0.1:7101 --task T3
  hapnet-peer --id 1 --remote 127.0.0.1:7001 --task T3 --record a.rec
  hapnet-peer --id 2 --remote 127.0.0.1:7002 --task T3 --record b.rec
  hapnet-peer --id 1 --remote 127.0.0.1:7001 --device falcon --force-limit 500mN
  hapnet-peer --key peer-1.key --listen 0.0.0.0:7000 --remote 203.0.113.2:7000
  hapnet-peer --id 1 --peer 2=127.0.0.1:7012 --peer 3=127.0.0.1:7013 --task T7
Each pair runs in two terminals. The second pair needs hapnet-emulator with --listen-a :7001
--listen-b :7002 between them. The falcon is for a device in your hand: read
docs/use/hardware.md, and run doctor and self-test first. The key is for two buildings: the other
host uses its own file of 'hapnet-peer keygen --peers 2 --out keys'. The last is one of three, with
hapnet-emulator --link 1-2=:7012,:7021 --link 1-3=:7013,:7031 --link 2-3=:7023,:7032 between them.

The peer prints one line "ready ..." on stdout when its loop runs, and events on stderr. SIGINT,
SIGTERM, SIGHUP, a terminal that goes away or hapnet-ctl SOCKET stop ends it within a second, with
zero force at once, and says goodbye to the others. Enter at its terminal, or hapnet-ctl SOCKET
estop, is an emergency stop: zero force until the program is started anew.)";

constexpr const char* exit_codes = R"(  0  done
  1  the run failed
  2  bad usage
  3  the system refused (port in use, no route, no such device), or the record
     or events are incomplete)";

constexpr const char* list_devices_description =
    "Lists every haptic device that can be seen, without opening any; for one that cannot be used, "
    "why and what to do. The first column is what --device takes. All backends: never run on the "
    "physical device.";
constexpr const char* list_devices_exit_codes = R"(  0  done, also when there is no device
  2  bad usage)";
constexpr const char* doctor_description =
    "Checks what this machine grants to a 1 kHz loop and to haptic devices, and says how to "
    "improve it. Without a device only the loop matters; the checks of devices were never run on "
    "the physical device.";
constexpr const char* doctor_exit_codes = R"(  0  no check is 'bad' (warnings do not count)
  2  bad usage
  3  a check is 'bad')";
constexpr const char* self_test_description =
    "Tries a device through the governor, step by step, and reports the results:\n"
    "  read       10 s without force: the rate at which the device sends, as a histogram\n"
    "  calibrate  what the device needs from you, such as its stylus in its holder, or its grip "
    "moved to every stop; it says so\n"
    "  force      a ramp to 0.2 N to the right, only while you hold the primary button\n"
    "  cable      you pull the cable, and the test checks that the loss is noticed\n"
    "Keep a loose grip, clear of the arm's way. --device sim shows a self-test without a device.";
constexpr const char* self_test_exit_codes = R"(  0  no step failed
  1  a step failed, you stopped the test, or the device went away
  2  bad usage
  3  the device cannot be opened)";

base::Result<std::string> parse_report_file(const std::string& file)
{
    if (file != "-") return file;
    return base::fail("'-' is not a file: the report needs one");
}

void add_self_test(cli::Command& command, SelfTestCommand& options)
{
    command.describe(self_test_description);
    command.add_exit_codes(self_test_exit_codes);
    add_device_options(command, options.device)
        .required("sim (hapnet-peer list-devices shows the others)");
    const auto step = cli::one_of({self_test_steps.begin(), self_test_steps.end()});
    command
        .option("--skip", "STEP", "Skip a step; may be given several times",
                [step, &options](const std::string& text) -> base::Result<void> {
                    auto named = step(text);
                    if (!named) return tl::unexpected{named.error()};
                    options.skip.push_back(*std::move(named));
                    return {};
                })
        .repeated();
    command.option("--read-for", "TIME", "How long to read without force (default 10s)",
                   cli::into(options.read_for,
                             base::Time{std::chrono::milliseconds{100}, std::chrono::minutes{10}}));
    command.option("--json", "FILE", "Write the report to FILE, too",
                   cli::into(options.json, parse_report_file));
}

/// Returns a command's options, unless they contradict each other.
template <typename Options>
net::CommandLine<Command> checked(base::Result<void> fine, Options options)
{
    if (!fine) return tl::unexpected{fine.error()};
    return Command{std::move(options)};
}

} // namespace

net::CommandLine<Command> parse_command_line(std::span<char*> words)
{
    cli::Command program{"hapnet-peer"};
    program.describe(description);
    program.add_footer(footer);
    program.add_exit_codes(exit_codes);
    Options session;
    Asked asked;
    add_session_options(program, session, asked);

    auto& list = program.command("list-devices", "Lists the haptic devices, and what keeps one "
                                                 "from being used");
    list.describe(list_devices_description);
    list.add_exit_codes(list_devices_exit_codes);
    ListDevicesCommand listing;
    add_finding_options(list, listing.options);
    list.flag("--json", "Print one JSON object instead of a table", listing.json);

    auto& check = program.command("doctor", "Checks this machine for a haptic loop, and says how "
                                            "to improve it");
    check.describe(doctor_description);
    check.add_exit_codes(doctor_exit_codes);
    DoctorCommand checking;
    bool prints_rules = false;
    check.flag("--json", "Print one JSON object instead of a table", checking.json);
    check.flag("--print-udev-rules", "Print the udev rules of this version and exit", prints_rules);
    check.option("--hd-library", "FILE", "The vendor's library of hdapi devices",
                 cli::into(checking.hd_library));

    auto& self_test = program.command("self-test", "Tries a device step by step, through the "
                                                   "governor");
    SelfTestCommand testing;
    add_self_test(self_test, testing);

    check.option("--key", "FILE", "Also whether a session would take this key file",
                 cli::into(checking.key));
    KeyCommands keys{program};
    const cli::SchemaCommand schema{program, schemas()};

    if (auto said = program.parse(words); !said || *said) return net::answer_of(std::move(said));
    if (schema.is_chosen()) return net::Answer{schema.text()};
    if (list.is_chosen()) return Command{std::move(listing)};
    if (prints_rules) return net::Answer{std::string{doctor::udev_rules()}};
    if (check.is_chosen()) return Command{std::move(checking)};
    if (self_test.is_chosen()) {
        auto fine = check_device_options(self_test, testing.device);
        return checked(std::move(fine), std::move(testing));
    }
    if (keys.is_chosen())
        return keys.chosen().map([](KeyCommand chosen) { return Command{std::move(chosen)}; });
    if (!asked.printed_algorithm.empty()) return net::Answer{asked.printed_algorithm};
    auto fine = complete(session, asked, program);
    return checked(std::move(fine), std::move(session));
}

} // namespace hapnet::peer
