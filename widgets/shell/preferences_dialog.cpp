// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/shell/preferences_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

#include "widgets/common/languages.h"
#include "widgets/common/parts.h"
#include "widgets/common/quantity_box.h"
#include "widgets/models/session_model.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

QFormLayout* section(QVBoxLayout* column, const QString& title) {
  column->addWidget(makeLabel(title, "sectionTitle"));
  auto* form = new QFormLayout;
  form->setHorizontalSpacing(16);
  form->setVerticalSpacing(8);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  column->addLayout(form);
  column->addSpacing(8);
  return form;
}

QLabel* note(const QString& text) {
  auto* label = makeLabel(text, "secondaryText");
  label->setWordWrap(true);
  return label;
}

}  // namespace

std::vector<std::pair<QString, QString>> languageChoices() {
  std::vector<std::pair<QString, QString>> choices = {{PreferencesDialog::tr("As the system"), QString()}};
  for (const Language& language : availableLanguages()) choices.emplace_back(language.own_name, language.code);
  return choices;
}

PreferencesDialog::PreferencesDialog(QWidget* parent) : QDialog(parent) {
  setObjectName(QStringLiteral("preferences"));
  setWindowTitle(tr("Preferences"));
  setAttribute(Qt::WA_DeleteOnClose);
  auto* outer = new QVBoxLayout(this);
  outer->setContentsMargins(24, 16, 24, 16);
  outer->setSpacing(8);
  const auto named = [](auto* widget, const char* object, const QString& name) {
    widget->setObjectName(QLatin1String(object));
    widget->setAccessibleName(name);
    return widget;
  };

  QFormLayout* look = section(outer, tr("Look and language"));
  look_ = named(new QComboBox, "look", tr("Theme"));
  look_->addItem(tr("As the system"), static_cast<int>(Preferences::Look::System));
  look_->addItem(tr("Light"), static_cast<int>(Preferences::Look::Light));
  look_->addItem(tr("Dark"), static_cast<int>(Preferences::Look::Dark));
  look->addRow(tr("Theme"), look_);
  language_ = named(new QComboBox, "language", tr("Language"));
  for (const auto& [name, code] : languageChoices()) language_->addItem(name, code);
  look->addRow(tr("Language, from the next start"), language_);

  QFormLayout* numbers = section(outer, tr("Units and numbers"));
  const auto units = [&](const char* object, const QString& name, const QString& of_files, const QString& other) {
    auto* box = named(new QComboBox, object, name);
    box->addItem(of_files, false);
    box->addItem(other, true);
    numbers->addRow(name, box);
    return box;
  };
  lengths_ = units("units_lengths", tr("Lengths and errors"), QStringLiteral("mm, µm"), QStringLiteral("in, µin"));
  angles_ = units("units_angles", tr("Angles"), QStringLiteral("µrad"), QStringLiteral("arcsec"));
  temperatures_ = units("units_temperatures", tr("Temperatures"), QStringLiteral("°C, K"), QStringLiteral("°F"));
  decimals_ = named(new QComboBox, "length_decimals", tr("Decimals of measured lengths in mm"));
  decimals_->addItem(tr("As each page finds fitting"), -1);
  for (int n = 0; n <= most_length_decimals; ++n) decimals_->addItem(tr("%1 mm").arg(decimalText(0.0, 'f', n)), n);
  numbers->addRow(tr("Measured lengths"), decimals_);
  numbers->addRow(
      note(tr("On screen. Files, exports, reports and the command line have µm, mm, µrad and °C; what is typed into "
              "the files of "
              "machine, artefacts and effects has the unit of the file.")));

  QFormLayout* folders = section(outer, tr("Folders"));
  auto* line = new QHBoxLayout;
  folder_ = named(new QLineEdit, "sessions_folder", tr("Folder for new sessions"));
  folder_->setMinimumWidth(240);
  auto* choose = makeButton(tr("Choose …"), "folder-open");
  choose->setAccessibleName(tr("Choose the folder for new sessions"));
  choose->setAutoDefault(false);
  line->addWidget(folder_, 1);
  line->addWidget(choose);
  folders->addRow(tr("New sessions"), line);
  problem_ = new Callout;
  outer->addWidget(problem_);

  QFormLayout* goals = section(outer, tr("Goals of a new campaign"));
  goal_um_ = named(new QuantityBox(QStringLiteral("um"), 1), "goal_um", tr("Goal of displacements"));
  goal_um_->setRange(0.1, 1000.0);
  goal_urad_ = named(new QuantityBox(QStringLiteral("urad"), 1), "goal_urad", tr("Goal of rotations"));
  goal_urad_->setRange(0.0, 10000.0);
  goal_urad_->setSpecialValueText(tr("none"));
  goals->addRow(tr("Displacements"), goal_um_);
  goals->addRow(tr("Rotations"), goal_urad_);
  goals->addRow(note(tr("What may remain after compensation. The step Verify keeps the goal of each campaign.")));

  QFormLayout* questions = section(outer, tr("Ask"));
  quitting_ = named(new QCheckBox(tr("before quitting while work is running")), "ask_before_quitting",
                    tr("Ask before quitting while work is running"));
  discarding_ = named(new QCheckBox(tr("before an edited effect is discarded")), "ask_before_discarding",
                      tr("Ask before an edited effect is discarded"));
  questions->addRow(quitting_);
  questions->addRow(discarding_);

  outer->addStretch(1);
  auto* buttons = new QHBoxLayout;
  auto* reset = named(makeButton(tr("Reset all"), "restore"), "reset", tr("Reset all preferences"));
  reset->setAutoDefault(false);
  auto* close = makeButton(tr("Close"), nullptr);
  close->setDefault(true);
  buttons->addWidget(reset);
  buttons->addStretch();
  buttons->addWidget(close);
  outer->addLayout(buttons);
  resize(560, sizeHint().height());

  // The fields of all sections stand below each other.
  int widest = 0;
  const std::array<QFormLayout*, 4> forms{look, numbers, folders, goals};
  const auto labels = [&forms](auto&& each) {
    for (const QFormLayout* form : forms) {
      for (int row = 0; row < form->rowCount(); ++row) {
        if (const QLayoutItem* item = form->itemAt(row, QFormLayout::LabelRole)) each(*item->widget());
      }
    }
  };
  labels([&](const QWidget& label) { widest = std::max(widest, label.sizeHint().width()); });
  labels([&](QWidget& label) { label.setFixedSize(widest, sizes::control_height); });

  fill();
  for (QComboBox* box : {look_, language_, lengths_, angles_, temperatures_, decimals_})
    connect(box, &QComboBox::currentIndexChanged, this, &PreferencesDialog::take);
  for (QDoubleSpinBox* box : {goal_um_, goal_urad_})
    connect(box, &QDoubleSpinBox::valueChanged, this, &PreferencesDialog::take);
  for (QCheckBox* box : {quitting_, discarding_}) connect(box, &QCheckBox::toggled, this, &PreferencesDialog::take);
  connect(folder_, &QLineEdit::editingFinished, this, &PreferencesDialog::takeFolder);
  connect(choose, &QPushButton::clicked, this, [this] {
    const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder for new sessions"), folder_->text());
    if (chosen.isEmpty()) return;
    folder_->setText(chosen);
    takeFolder();
  });
  connect(reset, &QPushButton::clicked, this, [this] {
    setPreferences({});
    fill();
  });
  connect(close, &QPushButton::clicked, this, &QDialog::accept);
  // Ctrl+D changes the theme while this is open.
  connect(&PreferencesNotifier::instance(), &PreferencesNotifier::changed, this, &PreferencesDialog::fill);
}

void PreferencesDialog::fill() {
  filling_ = true;
  const Preferences now = preferences();
  look_->setCurrentIndex(look_->findData(static_cast<int>(now.look)));
  language_->setCurrentIndex(std::max(0, language_->findData(now.language)));
  lengths_->setCurrentIndex(now.units.inches ? 1 : 0);
  angles_->setCurrentIndex(now.units.arcseconds ? 1 : 0);
  temperatures_->setCurrentIndex(now.units.fahrenheit ? 1 : 0);
  decimals_->setCurrentIndex(decimals_->findData(now.length_decimals.value_or(-1)));
  folder_->setText(now.sessions_folder);
  folder_->setPlaceholderText(QDir::toNativeSeparators(usualSessionsFolder()));
  goal_um_->setValue(now.goal_um);
  goal_urad_->setValue(now.goal_urad);
  quitting_->setChecked(now.ask_before_quitting);
  discarding_->setChecked(now.ask_before_discarding);
  filling_ = false;
}

void PreferencesDialog::take() {
  if (filling_) return;
  Preferences now = preferences();
  now.look = static_cast<Preferences::Look>(look_->currentData().toInt());
  now.language = language_->currentData().toString();
  now.units = {lengths_->currentIndex() == 1, angles_->currentIndex() == 1, temperatures_->currentIndex() == 1};
  const int decimals = decimals_->currentData().toInt();
  now.length_decimals = decimals < 0 ? std::nullopt : std::optional(decimals);
  now.goal_um = goal_um_->value();
  now.goal_urad = goal_urad_->value();
  now.ask_before_quitting = quitting_->isChecked();
  now.ask_before_discarding = discarding_->isChecked();
  setPreferences(now);
}

void PreferencesDialog::takeFolder() {
  Preferences now = preferences();
  const QString wanted = QDir::fromNativeSeparators(folder_->text().trimmed());
  if (wanted == now.sessions_folder) {
    problem_->set(Tone::Neutral, {});
    return;
  }
  // A folder that cannot be written to is noticed here and not after an hour of captures.
  if (!wanted.isEmpty() &&
      (!QDir::isAbsolutePath(wanted) || !QDir().mkpath(wanted) || !QFileInfo(wanted).isWritable())) {
    problem_->show(
        Tone::Bad,
        tr("Nothing can be written to \"%1\"; allowed: a folder of yours, from the root on. New sessions go on "
           "to %2.")
            .arg(wanted, QString::fromStdString(sessionsFolder().string())));
    return;
  }
  problem_->set(Tone::Neutral, {});
  now.sessions_folder = wanted;
  setPreferences(now);
}

}  // namespace spindrift::gui
