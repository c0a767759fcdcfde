// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupling/fmi/variables.h"

#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "furrow/core/error.h"
#include "furrow/io/files/version.h"

namespace furrow::coupling::fmi {

const std::array<Variable, real_count> reals{{
    {"position_x", "m", "Axle along x at the start of the step"},
    {"position_y", "m", "Axle along y at the start of the step"},
    {"position_z", "m", "Axle along z at the start of the step"},
    {"yaw", "rad", "Heading of the wheel at the start of the step"},
    {"camber", "rad", "Camber of the wheel at the start of the step"},
    {"velocity_x", "m/s", "Velocity of the axle during the step"},
    {"velocity_y", "m/s", "Velocity of the axle during the step"},
    {"velocity_z", "m/s", "Velocity of the axle during the step"},
    {"yaw_rate", "rad/s", "Rate of the heading during the step"},
    {"camber_rate", "rad/s", "Rate of the camber during the step"},
    {"load", "N", "Downward force on the axle, weight included; with height_by_load"},
    {"spin_torque", "N.m", "Torque of a motor or brake, positive drives; with spin_by_torque"},
    {"spin_rate", "rad/s", "Spin rate, positive rolls forward; without spin_by_torque"},
    {"force_x", "N", "Force of the ground on the wheel"},
    {"force_y", "N", "Force of the ground on the wheel"},
    {"force_z", "N", "Force of the ground on the wheel"},
    {"moment_x", "N.m", "Moment of the ground about the centre of the axle"},
    {"moment_y", "N.m", "Moment of the ground about the centre of the axle"},
    {"moment_z", "N.m", "Moment of the ground about the centre of the axle"},
    {"hub_z", "m", "Height of the axle"},
    {"hub_velocity_z", "m/s", "Velocity of the axle along z, half a step of Furrow earlier"},
    {"hub_spin", "rad", "Spin angle"},
    {"hub_spin_rate", "rad/s", "Spin rate, half a step of Furrow earlier"},
}};

const std::array<Variable, boolean_count> booleans{{
    {"spin_by_torque", "", "spin_torque spins the wheel, otherwise spin_rate"},
    {"height_by_load", "", "load moves the axle along z, otherwise position_z and velocity_z"},
}};

const std::array<Variable, first_script_variable> strings{{
    {"script", "", "Script of one wheel on its ground, from the folder resources"},
    {"log", "", "File for the messages of the script; none without a name"},
}};

Contents read_contents(const std::string& file) {
  std::ifstream stream(file);
  if (!stream)
    throw Error("file '" + file + "' cannot be read; the FMU needs its folder resources");
  try {
    const nlohmann::json json = nlohmann::json::parse(stream);
    Contents contents;
    contents.guid = json.at("guid");
    contents.script = json.at("script");
    contents.keeps_states = json.at("keeps_states");
    for (const auto& each : json.at("variables"))
      contents.variables.push_back({each.at("name"), each.at("value")});
    return contents;
  } catch (const nlohmann::json::exception& problem) {
    throw Error("file '" + file + "' is no description of an FMU of Furrow: " + problem.what());
  }
}

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

/// Element of modelDescription.xml for one variable.
std::string real(unsigned i, int version) {
  const Variable& each = reals[i];
  const bool given = i < first_output;
  const std::string attributes = fmt::format(
      "name=\"{}\" valueReference=\"{}\" description=\"{}\" causality=\"{}\" "
      "variability=\"continuous\"",
      each.name, i, each.meaning, given ? "input" : "output");
  const std::string value = fmt::format("unit=\"{}\"{}", each.unit, given ? " start=\"0\"" : "");
  if (version == 3) return fmt::format("    <Float64 {} {}/>\n", attributes, value);
  return fmt::format("    <ScalarVariable {}><Real {}/></ScalarVariable>\n", attributes, value);
}

std::string parameter(const std::string& name, unsigned reference, const std::string& meaning) {
  return fmt::format(
      "name=\"{}\" valueReference=\"{}\" description=\"{}\" causality=\"parameter\" "
      "variability=\"fixed\" initial=\"exact\"",
      escaped(name), reference, escaped(meaning));
}

std::string boolean(unsigned i, int version) {
  const std::string attributes =
      parameter(booleans[i].name, i + (version == 3 ? first_boolean_of_3 : 0), booleans[i].meaning);
  const std::string value = fmt::format("start=\"{}\"", boolean_starts[i]);
  if (version == 3) return fmt::format("    <Boolean {} {}/>\n", attributes, value);
  return fmt::format("    <ScalarVariable {}><Boolean {}/></ScalarVariable>\n", attributes, value);
}

std::string text(const std::string& name, unsigned i, const std::string& meaning,
                 const std::string& value, int version) {
  const std::string attributes =
      parameter(name, i + (version == 3 ? first_string_of_3 : 0), meaning);
  if (version == 3)
    return fmt::format("    <String {}><Start value=\"{}\"/></String>\n", attributes,
                       escaped(value));
  return fmt::format("    <ScalarVariable {}><String start=\"{}\"/></ScalarVariable>\n", attributes,
                     escaped(value));
}

/// Lists the outputs, which are also unknown at the start.
std::string structure(int version) {
  std::string outputs, unknowns;
  for (unsigned i = first_output; i < real_count; ++i) {
    outputs += version == 3 ? fmt::format("    <Output valueReference=\"{}\"/>\n", i)
                            : fmt::format("      <Unknown index=\"{}\"/>\n", i + 1);
    unknowns += fmt::format("    <InitialUnknown valueReference=\"{}\"/>\n", i);
  }
  if (version == 3) return outputs + unknowns;
  return "    <Outputs>\n" + outputs + "    </Outputs>\n    <InitialUnknowns>\n" + outputs +
         "    </InitialUnknowns>\n";
}

constexpr char units[] = R"(  <UnitDefinitions>
    <Unit name="m"><BaseUnit m="1"/></Unit>
    <Unit name="rad"><BaseUnit rad="1"/></Unit>
    <Unit name="m/s"><BaseUnit m="1" s="-1"/></Unit>
    <Unit name="rad/s"><BaseUnit rad="1" s="-1"/></Unit>
    <Unit name="N"><BaseUnit kg="1" m="1" s="-2"/></Unit>
    <Unit name="N.m"><BaseUnit kg="1" m="2" s="-2"/></Unit>
  </UnitDefinitions>
)";

}  // namespace

std::string describe(const Contents& contents, const std::string& name, int version) {
  std::string variables;
  for (unsigned i = 0; i < real_count; ++i) variables += real(i, version);
  for (unsigned i = 0; i < boolean_count; ++i) variables += boolean(i, version);
  for (unsigned i = 0; i < first_script_variable; ++i)
    variables +=
        text(strings[i].name, i, strings[i].meaning, i == script ? contents.script : "", version);
  for (std::size_t i = 0; i < contents.variables.size(); ++i)
    variables += text("variables." + contents.variables[i].name,
                      first_script_variable + static_cast<unsigned>(i), "Variable of the script",
                      contents.variables[i].value, version);
  const bool third = version == 3;
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="{version}.0" modelName="{name}" {token}="{guid}"
    description="One wheel on soft ground" generationTool="Furrow {furrow}" variableNamingConvention="structured">
  <CoSimulation modelIdentifier="furrow_wheel" canHandleVariableCommunicationStepSize="true"{memory}
      canGetAndSetFMU{state}="{states}" canSerializeFMU{state}="{states}"/>
{units}  <LogCategories>
    <Category name="logStatusError"/>
    <Category name="logStatusDiscard"/>
    <Category name="logStatusWarning"/>
  </LogCategories>
  <ModelVariables>
{variables}  </ModelVariables>
  <ModelStructure>
{structure}  </ModelStructure>
</fmiModelDescription>
)",
      fmt::arg("version", version), fmt::arg("name", escaped(name)),
      fmt::arg("token", third ? "instantiationToken" : "guid"),
      fmt::arg("guid", escaped(contents.guid)), fmt::arg("furrow", furrow::version()),
      fmt::arg("memory", third ? "" : " canNotUseMemoryManagementFunctions=\"true\""),
      fmt::arg("state", third ? "State" : "state"), fmt::arg("states", contents.keeps_states),
      fmt::arg("units", units), fmt::arg("variables", variables),
      fmt::arg("structure", structure(version)));
}

}  // namespace furrow::coupling::fmi
