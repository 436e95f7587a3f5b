// The command `gnomon verify`, which checks that a model file is complete and that its stored error bounds are correct.

#include "app/command_line.h"
#include "app/commands.h"
#include "app/thread_limit.h"
#include "core/error.h"
#include "core/printable.h"
#include "preprocess/verify/verify.h"
#include "telemetry/json_text.h"

#include <cmath>
#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

namespace gnomon::app {

namespace {

using nlohmann::ordered_json;

ordered_json checkJson(const verify::Check& check) {
    ordered_json json;
    json["name"] = check.name;
    json["tested"] = check.tested;
    json["failed"] = check.failed;
    // JSON has no infinity. `worst` is infinite for a distance above 0 where the stored error is 0.
    json["worst"] = std::isfinite(check.worst) ? check.worst : 1e308;
    json["detail"] = check.detail;
    if (check.tightness) json["tightness"] = *check.tightness;
    for (const verify::SampledCut& cut : check.cuts)
        json["cuts"].push_back(
            {{"triangles", cut.triangles},
             {"stored", cut.stored},
             {"sampled_rms", cut.sampledRms},
             {"sampled_largest", cut.sampledLargest}});
    return json;
}

void print(const verify::Verification& verification, bool asJson) {
    if (asJson) {
        ordered_json json{{"ok", verification.ok()}, {"checks", ordered_json::array()}};
        for (const verify::Check& check : verification.checks)
            json["checks"].push_back(checkJson(check));
        std::printf("%s\n", telemetry::jsonText(json, 1).c_str());
        return;
    }
    for (const verify::Check& check : verification.checks) {
        std::printf(
            "%-14s %12llu tested %8llu failed  worst %-12g",
            check.name.c_str(),
            static_cast<unsigned long long>(check.tested),
            static_cast<unsigned long long>(check.failed),
            check.worst);
        if (check.tightness) std::printf(" tightness %.2f", *check.tightness);
        std::printf(" %s\n", printable(check.detail).c_str());
    }
}

} // namespace

void addVerifyCommand(CLI::App& program) {
    struct Options {
        verify::VerifyOptions verify;
        CommonOptions common;
        std::string memory = "2G";
        bool json = false;
    };

    auto options = std::make_shared<Options>();
    CLI::App* command =
        program.add_subcommand("verify", "Check a model: checksums, structure, cracks and stored errors");
    addModel(*command, options->verify.model);
    command
        ->add_option(
            "--source", options->verify.source, "Meshes of the model, whose distances are compared with stored errors")
        ->type_name("INPUT");
    command
        ->add_option(
            "--source-root",
            options->verify.sourceRoot,
            "Folder that textures, buffers and material libraries of --source may come from")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR")
        ->default_str("the folder of the source");
    command->add_option("--cuts", options->verify.cuts, "Number of random views that are searched for cracks")
        ->check(CLI::Range(0, 1'000'000))
        ->type_name("N")
        ->capture_default_str();
    command->add_option("--seed", options->verify.seed, "Seed of the random views and samples")
        ->check(seedText())
        ->type_name("S")
        ->capture_default_str();
    command->add_option("--memory", options->memory, "Max resident memory of the process")
        ->check(memorySize())
        ->type_name("SIZE")
        ->capture_default_str();
    command->add_flag("--json", options->json, "Print one JSON document on stdout");
    addCommonOptions(*command, options->common);
    command->callback([options] {
        const auto progress = makeProgress(options->common);
        const ThreadLimit limit(options->common);
        options->verify.memory = *parseBytes(options->memory);
        const verify::Verification verification = verify::verifyModel(options->verify, *progress);
        print(verification, options->json);
        for (const verify::Check& c : verification.checks)
            if (c.failed > 0)
                throw Error(
                    options->verify.model + ": " + c.name + ": " + std::to_string(c.failed) + " failed: " + c.detail);
    });
}

} // namespace gnomon::app
