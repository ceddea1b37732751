// SPDX-License-Identifier: GPL-3.0-or-later
// A machine with a known expansion and a known sag, and the three controls as their manuals describe them: with the
// table that was written, the error that is left is the same everywhere. The golden values were worked out by hand.
#include "core/machine/control_tables.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

namespace spindrift {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// The screw of X is too long: 0.1 um per mm; the table sags over X: EZ = -0.002 um/mm^2 (x - 50)^2; X is not square
/// to Y: EY = 0.04 um per mm of x; EX = -0.06 um per mm of y.
class KnownMachine final : public ErrorModel {
 public:
  [[nodiscard]] std::string description() const override { return "known"; }
  [[nodiscard]] PredictedComponent predict(const DeviationQuery& q, Component component) const override {
    const Eigen::Vector3d& p = q.position_mm;
    if (component == Component::EX) return {0.1 * p.x() - 0.06 * p.y() + 2.0 * q.approach.x(), 0.5};
    if (component == Component::EY) return {0.04 * p.x(), 0.5};
    if (component == Component::EZ) return {-0.002 * std::pow(p.x() - 50.0, 2), 0.5};
    return {};
  }
};

MachineDescription knownMill() {
  const auto root = JsonNode::parse(
      R"({"format":"spindrift-machine","version":1,"name":"mill","chain":"V [w-X'-Y'-b-Z-t]",
          "axes":[{"name":"X","travel_mm":[-60,100]},{"name":"Y","travel_mm":[0,50]},{"name":"Z","travel_mm":[-10,10]}]})",
      "machine.json");
  return MachineDescription::parse(root, "machine.json");
}

const Eigen::Vector3d reference_mm(20.0, 0.0, 0.0);

AxisComponentTable tableOf(const std::string& axis, int count) {
  return axisComponents(KnownMachine(), knownMill(), axis, reference_mm, count, {});
}

double deviation_mm(const Eigen::Vector3d& at, Component component) {
  DeviationQuery query;
  query.position_mm = at;
  return 1e-3 * KnownMachine().predict(query, component).value;
}

/// Where the axes really are when X, Y, Z are commanded, on a control that moves them as the tables say.
Eigen::Vector3d reallyAt(const Eigen::Vector3d& commanded, const std::vector<ControlTable>& tables) {
  Eigen::Vector3d at = commanded;
  for (const ControlTable& table : tables) at[table.axis - 'X'] += table.movementAt(commanded[table.base - 'X']);
  for (int i = 0; i < 3; ++i) at[i] += deviation_mm(commanded, static_cast<Component>(i));
  return at;
}

// K3, 5.4.3: "A positive compensation value causes the corresponding machine axis to move in the negative direction."
TEST(ControlTables, SagTableMovesTheAxisAgainstTheDeviation) {
  const std::string text = siemensSagCompensation({tableOf("X", 5)});
  // At x = -60: EY = 0.04 (-60 - 20) um = -3.2 um; EZ = -0.002 (110^2 - 30^2) um = -22.4 um: the axes have to go up.
  EXPECT_THAT(text, HasSubstr("%_N_NC_CEC_INI\n"));
  EXPECT_THAT(text, HasSubstr("$AN_CEC[0,0]=-0.003200\n$AN_CEC[0,1]=-0.001600\n$AN_CEC[0,2]=0.000000\n"
                              "$AN_CEC[0,3]=0.001600\n$AN_CEC[0,4]=0.003200\n"));
  EXPECT_THAT(text, HasSubstr("$AN_CEC_INPUT_AXIS[0]=(X1)\n$AN_CEC_OUTPUT_AXIS[0]=(Y1)\n$AN_CEC_STEP[0]=40.000000\n"
                              "$AN_CEC_MIN[0]=-60.000000\n$AN_CEC_MAX[0]=100.000000\n$AN_CEC_DIRECTION[0]=0\n"));
  EXPECT_THAT(text, HasSubstr("$AN_CEC[1,0]=-0.022400\n"));
  EXPECT_THAT(text, HasSubstr("$AN_CEC_OUTPUT_AXIS[1]=(Z1)\n"));
  EXPECT_THAT(text, HasSubstr("\nM17\n"));
  const std::vector<ControlTable> read = readSiemensTables(text, "siemens_cec.ini");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_DOUBLE_EQ(read[1].movementAt(-60.0), 0.0224);
}

TEST(ControlTables, SiemensTablesTogetherLeaveTheSameEverywhere) {
  std::vector<ControlTable> tables;
  std::vector<AxisComponentTable> components;
  for (const char* axis : {"X", "Y", "Z"}) {
    components.push_back(tableOf(axis, 5));
    const std::string own = siemensCompensation(KnownMachine(), knownMill(), axis, reference_mm, 5, {});
    for (const ControlTable& table : readSiemensTables(own, "siemens_eec.ini")) tables.push_back(table);
  }
  for (const ControlTable& table : readSiemensTables(siemensSagCompensation(components), "siemens_cec.ini"))
    tables.push_back(table);
  EXPECT_EQ(tables.size(), 6U) << "three screws, Y and Z over X, X over Y";
  const Eigen::Vector3d left = reallyAt(reference_mm, tables) - reference_mm;
  for (const double x : {-60.0, -20.0, 20.0, 60.0, 100.0}) {
    for (const double y : {0.0, 25.0, 50.0}) {
      const Eigen::Vector3d commanded(x, y, 5.0);
      EXPECT_LT((reallyAt(commanded, tables) - commanded - left).norm(), 2e-6) << x << ' ' << y;
    }
  }
}

// TNC 407/415/425, 1.6.3: "The error is positive if the table travel is too long, and negative if the travel is too
// short"; TNC 406/306, p. 4-21: the points of the error curve are entered.
TEST(ControlTables, HeidenhainValuesAreTheErrorFromTheDatum) {
  const std::string text = heidenhainCompensation(tableOf("X", 5));
  // X travels 16 um too far over 160 mm; EZ rises by 24.2 um to x = 50 and falls again.
  EXPECT_THAT(text, HasSubstr("AXISPOS_mm,X_mm,Y_mm,Z_mm\n-60.000000,0.000000,0.000000,0.000000\n"
                              "-20.000000,0.004000,0.001600,0.014400\n"));
  EXPECT_THAT(text, HasSubstr("\n100.000000,0.016000,0.006400,0.019200\n"));
  EXPECT_THAT(text, HasSubstr("datum -60 mm, distance 40 mm, 5 points"));
  const std::vector<ControlTable> over_x = readHeidenhainTable(text, "heidenhain_X.csv");
  ASSERT_EQ(over_x.size(), 3U);
  EXPECT_EQ(over_x[2].axis, 'Z');
  EXPECT_EQ(over_x[2].base, 'X');
  std::vector<ControlTable> tables = over_x;
  for (const ControlTable& t : readHeidenhainTable(heidenhainCompensation(tableOf("Y", 3)), "heidenhain_Y.csv"))
    tables.push_back(t);
  const Eigen::Vector3d left = reallyAt({-60.0, 0.0, 0.0}, tables) - Eigen::Vector3d(-60.0, 0.0, 0.0);
  for (const double x : {-60.0, -20.0, 60.0, 100.0}) {
    for (const double y : {0.0, 50.0}) {
      const Eigen::Vector3d commanded(x, y, 0.0);
      EXPECT_LT((reallyAt(commanded, tables) - commanded - left).norm(), 2e-6) << x << ' ' << y;
    }
  }
}

AxisComponentTable pitchOf(const FanucPoints& points) {
  return axisComponentsAt(KnownMachine(), knownMill(), "X", reference_mm, points.position_mm(), {});
}

/// A control goes straight from point to point, also over the end of the travel, which is no point.
TEST(ControlTables, FanucIsRightUpToTheEndsOfTheTravel) {
  class Straight final : public ErrorModel {
   public:
    [[nodiscard]] std::string description() const override { return "straight"; }
    [[nodiscard]] PredictedComponent predict(const DeviationQuery& query, Component component) const override {
      return {component == Component::EX ? 0.04 * query.position_mm.x() : 0.0, 0.1};
    }
  };
  const LinearAxis axis = *knownMill().findAxis("X");
  for (const int count : {2, 4, 6, 10}) {
    const FanucPoints points = FanucPoints::over(axis, count, 0);
    ASSERT_TRUE(points.position_mm().front() < axis.travel_mm[0] || points.position_mm().back() > axis.travel_mm[1]);
    const AxisComponentTable table =
        axisComponentsAt(Straight(), knownMill(), "X", reference_mm, points.position_mm(), {});
    const ControlTable curve =
        readFanucPitchError(fanucPitchError(table, points, FanucStep::Positive, 0.1), "fanuc_X.nc");
    for (double x = axis.travel_mm[0]; x <= axis.travel_mm[1]; x += 1.0)
      EXPECT_NEAR(curve.movementAt(x) - curve.movementAt(reference_mm.x()), -4e-5 * (x - reference_mm.x()), 1.1e-4)
          << count << ' ' << x;
  }
}

// B-63980EN, p. 99 and 100: stroke -400 to 800 mm, interval 50 mm, reference position 40: points 33 to 56.
TEST(ControlTables, FanucNumbersAreThoseOfTheManualsExample) {
  LinearAxis axis;
  axis.name = "X";
  axis.travel_mm = {-400.0, 800.0};
  const FanucPoints points = FanucPoints::over(axis, 25, 32);
  EXPECT_DOUBLE_EQ(points.interval_mm, 50.0);
  EXPECT_EQ(points.reference, 40);
  EXPECT_EQ(points.first, 33);
  EXPECT_EQ(points.last, 56);
  EXPECT_EQ(points.position_mm().size(), 25U);
  // Its values from 33 to 49, and the curve drawn from them: +4 at -250 mm, 0 at the reference position, -1 at 300 mm.
  std::string program =
      "%\n(AXIS X)\n(REFERENCE 40 PARAMETER 3620)\n(INTERVAL 50 MM)\n(UNIT 1 MICROMETRES)\n(STEP PLUS)\nG10 L50\n";
  int number = 33;
  for (const int value : {2, 1, 1, -2, 0, -1, 0, -1, 2, 1, 0, -1, -1, -2, 0, 1, 2})
    program += fmt::format("N{} R{}\n", 10000 + number++, value);
  const ControlTable curve = readFanucPitchError(program, "example");
  for (const auto& [at, units] : std::vector<std::pair<double, double>>{
           {-400, 0}, {-250, 4}, {-200, 2}, {-50, 1}, {0, 0}, {100, 3}, {250, 1}, {300, -1}, {450, 2}})
    EXPECT_NEAR(curve.movementAt(at), 1e-3 * units, 1e-12) << at;
}

TEST(ControlTables, FanucStepsCancelTheExpansionWhicheverWayTheyCount) {
  LinearAxis axis = *knownMill().findAxis("X");
  const FanucPoints points = FanucPoints::over(axis, 9, 0);  // 20 mm
  EXPECT_EQ(points.reference, 3);
  const std::string plus = fanucPitchError(pitchOf(points), points, FanucStep::Positive, 1.0);
  const std::string minus = fanucPitchError(pitchOf(points), points, FanucStep::Negative, 1.0);
  // 2 um too far in each section of 20 mm: two units back.
  EXPECT_THAT(plus, HasSubstr("G10 L50\nN10001 R-2\nN10002 R-2\nN10003 R-2\nN10004 R-2\n"));
  EXPECT_THAT(plus, HasSubstr("N10008 R-2\nG11\nM30\n%\n"));
  EXPECT_THAT(plus, HasSubstr("(REFERENCE 3 PARAMETER 3620)\n(FIRST 1 PARAMETER 3621)\n(LAST 8 PARAMETER 3622)\n"));
  EXPECT_THAT(minus, HasSubstr("G10 L50\nN10001 R2\n"));
  for (const std::string& program : {plus, minus}) {
    const ControlTable table = readFanucPitchError(program, "fanuc_X.nc");
    EXPECT_DOUBLE_EQ(table.movementAt(0.0), 0.0) << "nothing at the reference position";
    for (const double x : {-60.0, -20.0, 20.0, 100.0}) {
      const double left = deviation_mm({x, 0.0, 0.0}, Component::EX) + table.movementAt(x);
      EXPECT_NEAR(left, 0.0, 1e-9) << x;
    }
  }
}

/// The page that says how far was measured stays at the desk; the file goes to the machine.
TEST(ControlTables, EveryFileSaysHowFarWasMeasured) {
  MeasuredBox measured;
  measured.low_mm = {-20.0, 10.0, 0.0};
  measured.high_mm = {60.0, 210.0, 5.0};
  const FanucPoints points = FanucPoints::over(*knownMill().findAxis("X"), 9, 0);
  const std::string fanuc = fanucPitchError(pitchOf(points), points, FanucStep::Positive, 1.0, measured);
  EXPECT_THAT(fanuc, HasSubstr("(X MEASURED FROM -20 TO 60 MM, BEYOND THAT EXTRAPOLATED)\n"));
  EXPECT_EQ(readFanucPitchError(fanuc, "fanuc_X.nc").movement_mm,
            readFanucPitchError(fanucPitchError(pitchOf(points), points, FanucStep::Positive, 1.0), "f").movement_mm);
  EXPECT_THAT(siemensCompensation(KnownMachine(), knownMill(), "Y", reference_mm, 5, {}, measured),
              HasSubstr("; Y measured from 10 to 210 mm; beyond that extrapolated\nCHANDATA(1)\n"));
  const AxisComponentTable over_y = tableOf("Y", 5);
  EXPECT_THAT(siemensSagCompensation({over_y}, measured),
              HasSubstr("; Y measured from 10 to 210 mm; beyond that extrapolated\nCHANDATA(1)\n"));
  EXPECT_THAT(heidenhainCompensation(over_y, measured),
              HasSubstr("# Y measured from 10 to 210 mm; beyond that extrapolated\nAXISPOS_mm"));
}

TEST(ControlTables, FanucRoundingDoesNotAddUp) {
  LinearAxis axis = *knownMill().findAxis("X");
  const FanucPoints points = FanucPoints::over(axis, 51, 0);  // 3.2 mm, 0.32 um each
  const ControlTable table =
      readFanucPitchError(fanucPitchError(pitchOf(points), points, FanucStep::Positive, 1.0), "fanuc_X.nc");
  const double at_zero = deviation_mm({0.0, 0.0, 0.0}, Component::EX);
  for (const double x : table.position_mm) {
    if (x < -60.0 || x > 100.0) continue;
    EXPECT_NEAR(deviation_mm({x, 0.0, 0.0}, Component::EX) - at_zero + table.movementAt(x), 0.0, 1.01e-3) << x;
  }
}

TEST(ControlTables, RefuseWhatAControlCannotTake) {
  AxisComponentTable wild = tableOf("X", 5);
  wild.deviation[2][1] = 1200.0;
  EXPECT_THAT(
      [&] { (void)siemensSagCompensation({wild}); },
      ThrowsMessage<InputError>(HasSubstr("EYX is 1.2 mm at 20 mm; allowed in a sag compensation: -1 to 1 mm.")));
  EXPECT_THAT([&] { (void)heidenhainCompensation(wild); },
              ThrowsMessage<InputError>(HasSubstr("1/64 of their distance")));
  EXPECT_THROW((void)siemensSagCompensation({tableOf("X", 201)}), InputError);
  EXPECT_THROW((void)heidenhainCompensation(tableOf("X", 257)), InputError);
  const FanucPoints points = FanucPoints::over(*knownMill().findAxis("X"), 3, 0);
  AxisComponentTable far = pitchOf(points);
  far.deviation[1][0] = 300.0;
  EXPECT_THAT([&] { (void)fanucPitchError(far, points, FanucStep::Positive, 1.0); },
              ThrowsMessage<InputError>(HasSubstr("allowed in pitch error data: -128 to 127")));
  EXPECT_THROW((void)fanucPitchError(pitchOf(points), points, FanucStep::Positive, 0.0), InputError);
  const FanucPoints late = FanucPoints::over(*knownMill().findAxis("X"), 3, 1022);
  EXPECT_THROW((void)fanucPitchError(pitchOf(late), late, FanucStep::Positive, 1.0), InputError);
}

TEST(ControlTables, LeaveOutWhatWasNotMeasured) {
  const MeasuredBox measured{{-60.0, 0.0, 0.0}, {100.0, 50.0, 0.0}, {true, false, true}};
  EXPECT_THAT(siemensSagCompensation({tableOf("X", 5)}, measured), ::testing::Not(HasSubstr("(Y1)")));
  EXPECT_EQ(siemensSagCompensation({tableOf("Z", 5)}, measured), "") << "nothing along Z";
  EXPECT_THAT(heidenhainCompensation(tableOf("X", 5), measured), HasSubstr("AXISPOS_mm,X_mm,Z_mm\n"));
  EXPECT_EQ(heidenhainCompensation(tableOf("Z", 5), measured), "");
}

TEST(ControlTables, ReadersSayWhatIsWrong) {
  EXPECT_THROW((void)readSiemensTables("$AN_CEC[0,0]=much\n", "a.ini"), InputError);
  EXPECT_THROW((void)readSiemensTables("$AN_CEC[0,0]=0.1\n", "a.ini"), InputError);
  EXPECT_THROW((void)readSiemensTables("$AN_CEC[0]=0.1\n", "a.ini"), InputError);
  EXPECT_THROW((void)readSiemensTables("$AN_CEC_INPUT_AXIS[0]=(Q1)\n", "a.ini"), InputError);
  EXPECT_THROW((void)readHeidenhainTable("AXISPOS_mm,X_mm\n0,0\n", "a.csv"), InputError);
  EXPECT_THROW((void)readFanucPitchError("N10001 R2\n", "a.nc"), InputError);
  EXPECT_THROW((void)readFanucPitchError(
                   "(AXIS X)\n(REFERENCE 3)\n(INTERVAL 20 MM)\n(UNIT 1)\n(STEP PLUS)\nN10001 R200\n", "a.nc"),
               InputError);
}

}  // namespace
}  // namespace spindrift
