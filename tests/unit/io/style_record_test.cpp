// SPDX-License-Identifier: GPL-2.0-or-later
#include "furrow/io/results/style_record.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace furrow::style_record_test {
namespace {

using Value = StyleRecord::Value;

Schema rig_schema() {
  Schema schema("fix wheel/rig");
  schema.number("speed", "m/s", Range::any(), "speed");
  schema.number("slip_angle", "degrees", Range::any(), "angle").by_default(0.0);
  schema.number("torque", "N m", Range::any(), "torque").optional();
  schema.integer("every", Range::at_least(1), "steps").by_default("10");
  schema.numbers("axle", 3, "m", Range::any(), "centre");
  schema.choice("mode", {"towed", "slip"}, "mode");
  schema.flag("half", "half");
  schema.text("wheel", "id");
  return schema;
}

StyleRecord rig_record() {
  const Options options = rig_schema().read(std::vector<std::string>{
      "speed", "2.235", "axle", "0", "-0.5", "1e-3", "mode", "slip", "wheel", "\"front\""});
  return {"rig", "all", "wheel/rig", "rig", typed_values(options)};
}

TEST(StyleRecord, ValuesHaveTheTypeOfTheirKey) {
  const StyleRecord record = rig_record();
  ASSERT_EQ(record.options.size(), 7u);  // no torque
  EXPECT_EQ(record.options[0].first, "speed");
  EXPECT_EQ(record.options[0].second, std::vector<Value>{2.235});
  EXPECT_EQ(record.options[1].second, std::vector<Value>{0.0});
  EXPECT_EQ(record.options[2].second, std::vector<Value>{std::int64_t{10}});
  EXPECT_EQ(record.options[3].second, (std::vector<Value>{0.0, -0.5, 1e-3}));
  EXPECT_EQ(record.options[4].second, std::vector<Value>{std::string("slip")});
  EXPECT_EQ(record.options[5].second, std::vector<Value>{false});
}

TEST(StyleRecord, JsonHasOneObjectForEachStyleWithListsOfValues) {
  const StyleRecord bed{
      "", "", "bed", "command", {{"script", {std::string("sand.lig")}}, {"seed", {86028121}}}};
  const auto json = nlohmann::json::parse(styles_json({bed, rig_record()}));
  ASSERT_EQ(json.size(), 2u);
  EXPECT_EQ(json[0]["style"], "bed");
  EXPECT_EQ(json[0]["kind"], "command");
  EXPECT_EQ(json[0]["options"]["seed"][0], 86028121);
  EXPECT_EQ(json[1]["id"], "rig");
  EXPECT_EQ(json[1]["group"], "all");
  EXPECT_EQ(json[1]["options"]["mode"], nlohmann::json({"slip"}));
  EXPECT_EQ(json[1]["options"]["half"], nlohmann::json({false}));
  EXPECT_EQ(json[1]["options"]["every"], nlohmann::json({10}));
  EXPECT_TRUE(json[1]["options"]["every"][0].is_number_integer());
  EXPECT_EQ(json[1]["options"]["axle"], nlohmann::json({0.0, -0.5, 1e-3}));
  EXPECT_EQ(json[1]["options"]["wheel"], nlohmann::json({"\"front\""}));
  EXPECT_FALSE(json[1]["options"].contains("torque"));
  EXPECT_TRUE(nlohmann::json::parse(styles_json({})).empty());
}

TEST(StyleRecord, NumericTextBecomesANumber) {
  EXPECT_EQ(typed_value("86028121"), Value(std::int64_t{86028121}));
  EXPECT_EQ(typed_value("-3"), Value(std::int64_t{-3}));
  EXPECT_EQ(typed_value("2e7"), Value(2e7));
  EXPECT_EQ(typed_value("0.015"), Value(0.015));
  EXPECT_EQ(typed_value("../beds/sand.lig"), Value(std::string("../beds/sand.lig")));
  EXPECT_EQ(typed_value("1.5m"), Value(std::string("1.5m")));
  EXPECT_EQ(typed_value(""), Value(std::string()));
}

}  // namespace
}  // namespace furrow::style_record_test
