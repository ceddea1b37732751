<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>CaptureTabs</name>
    <message>
        <source>Arriving</source>
        <translation>Eingang</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Captures</source>
        <translation>Aufnahmen</translation>
    </message>
</context>
<context>
    <name>Cells</name>
    <message>
        <source>%1 and %2</source>
        <translation>%1 und %2</translation>
    </message>
    <message>
        <source>%1 more</source>
        <translation>%1 weitere</translation>
    </message>
</context>
<context>
    <name>Commands</name>
    <message>
        <source>%1 items</source>
        <translation>%1 Elemente</translation>
    </message>
    <message>
        <source>edit machine</source>
        <translation>Maschine bearbeiten</translation>
    </message>
    <message>
        <source>exclude %1</source>
        <translation>%1 ausschließen</translation>
    </message>
    <message>
        <source>restore %1</source>
        <translation>%1 wiederherstellen</translation>
    </message>
    <message>
        <source>discard what was typed</source>
        <translation>Eingaben verwerfen</translation>
    </message>
    <message>
        <source>show what was typed</source>
        <translation>Eingaben zeigen</translation>
    </message>
    <message>
        <source>add a note</source>
        <translation>Notiz hinzufügen</translation>
    </message>
    <message>
        <source>remove a note</source>
        <translation>Notiz entfernen</translation>
    </message>
</context>
<context>
    <name>Demo</name>
    <message>
        <source>A hole bar on a turning table separates the errors of axis, table and artefact.</source>
        <translation>Eine Lochleiste auf einem Drehtisch trennt die Abweichungen von Achse, Tisch und Prüfkörper.</translation>
    </message>
    <message>
        <source>Ball artefact and star stylus</source>
        <translation>Kugelnormal und Sterntaster</translation>
    </message>
    <message>
        <source>Cold and warm scans of free-form artefacts give six errors of an axis.</source>
        <translation>Kalte und warme Scans von Freiform-Prüfkörpern ergeben sechs Abweichungen einer Achse.</translation>
    </message>
    <message>
        <source>Fiducials under the microscope</source>
        <translation>Messmarken unter dem Mikroskop</translation>
    </message>
    <message>
        <source>Find where simulation and measurement disagree, name the missing effect, see the gap shrink.</source>
        <translation>Finden, wo Simulation und Messung voneinander abweichen, den fehlenden Effekt benennen, die Differenz schrumpfen sehen.</translation>
    </message>
    <message>
        <source>Hole artefact and touch probe</source>
        <translation>Lochleiste und Messtaster</translation>
    </message>
    <message>
        <source>Images of two thermal states become a heat map of the table.</source>
        <translation>Aus Bildern zweier thermischer Zustände wird eine Farbkarte des Tisches.</translation>
    </message>
    <message>
        <source>Laser profiler on a gantry</source>
        <translation>Laser-Profilsensor an einer Portalmaschine</translation>
    </message>
    <message>
        <source>Rotations and growth of a horizontal machine from four balls.</source>
        <translation>Drehungen und Ausdehnung einer Horizontalmaschine aus vier Kugeln.</translation>
    </message>
    <message>
        <source>What the simulation lacks</source>
        <translation>Was in der Simulation fehlt</translation>
    </message>
    <message>
        <source>A campaign with its own pattern.json: 7 × 7 ellipses on a pitch of 455 µm.</source>
        <translation>Eine Kampagne mit eigener pattern.json: 7 × 7 Ellipsen im Raster von 455 µm.</translation>
    </message>
    <message>
        <source>Fiducials of your own artwork</source>
        <translation>Messmarken nach eigener Vorlage</translation>
    </message>
</context>
<context>
    <name>Dropped</name>
    <message>
        <source>%1 cannot be opened; allowed: the folder of a session or a campaign, a log (.csv), point clouds (.pcd, .ply) and images (.jpg, .png, .tif, .bmp, .pgm).</source>
        <translation>%1 kann nicht geöffnet werden; zulässig: der Ordner einer Sitzung oder einer Kampagne, ein Protokoll (.csv), Punktwolken (.pcd, .ply) und Bilder (.jpg, .png, .tif, .bmp, .pgm).</translation>
    </message>
    <message>
        <source>%1 is not there any more.</source>
        <translation>%1 ist nicht mehr vorhanden.</translation>
    </message>
    <message>
        <source>Images and point clouds are captures of a campaign; open a session or begin a new measurement first.</source>
        <translation>Bilder und Punktwolken sind Aufnahmen einer Kampagne; zuerst eine Sitzung öffnen oder eine neue Messung beginnen.</translation>
    </message>
    <message>
        <source>Sessions, campaigns and logs are opened one at a time; drop one of them, or captures alone.</source>
        <translation>Sitzungen, Kampagnen und Protokolle werden einzeln geöffnet; eines davon oder nur Aufnahmen ablegen.</translation>
    </message>
    <message>
        <source>The folder %1 is neither a session nor a campaign: it has no campaign.json. Captures in it are taken when it is chosen on the page Capture.</source>
        <translation>Der Ordner %1 ist weder eine Sitzung noch eine Kampagne: er enthält keine campaign.json. Aufnahmen darin werden übernommen, wenn er auf der Seite „Aufnahme“ gewählt wird.</translation>
    </message>
</context>
<context>
    <name>EditorTable</name>
    <message>
        <source>Choose a row of the table first.</source>
        <translation>Zuerst eine Zeile der Tabelle wählen.</translation>
    </message>
</context>
<context>
    <name>Effect</name>
    <message>
        <source>%1 rms in %2</source>
        <translation>%1 rms in %2</translation>
    </message>
    <message>
        <source>%1 and %2</source>
        <translation>%1 und %2</translation>
    </message>
    <message>
        <source>all %1</source>
        <translation>alle %1</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>Room temperature</source>
        <translation>Raumtemperatur</translation>
    </message>
    <message>
        <source>Artefact</source>
        <translation>Prüfkörper</translation>
    </message>
    <message>
        <source>Backlash</source>
        <translation>Umkehrspanne</translation>
    </message>
    <message>
        <source>Ball screws</source>
        <translation>Kugelgewindetriebe</translation>
    </message>
    <message>
        <source>Column</source>
        <translation>Ständer</translation>
    </message>
    <message>
        <source>Coolant</source>
        <translation>Kühlschmierstoff</translation>
    </message>
    <message>
        <source>Crossbeam</source>
        <translation>Querbalken</translation>
    </message>
    <message>
        <source>Heat from outside</source>
        <translation>Wärme von außen</translation>
    </message>
    <message>
        <source>Fixture</source>
        <translation>Spannvorrichtung</translation>
    </message>
    <message>
        <source>Frame</source>
        <translation>Gestell</translation>
    </message>
    <message>
        <source>Head</source>
        <translation>Spindelkopf</translation>
    </message>
    <message>
        <source>Moving heat source</source>
        <translation>Bewegte Wärmequelle</translation>
    </message>
    <message>
        <source>Instrument</source>
        <translation>Messgerät</translation>
    </message>
    <message>
        <source>Periodic errors</source>
        <translation>Periodische Abweichungen</translation>
    </message>
    <message>
        <source>Rotary table</source>
        <translation>Drehtisch</translation>
    </message>
    <message>
        <source>Linear scales</source>
        <translation>Längenmesssysteme</translation>
    </message>
    <message>
        <source>Spindle</source>
        <translation>Spindel</translation>
    </message>
    <message>
        <source>Squareness</source>
        <translation>Rechtwinkligkeit</translation>
    </message>
    <message>
        <source>Table</source>
        <translation>Tisch</translation>
    </message>
</context>
<context>
    <name>ExcludeItems</name>
    <message numerus="yes">
        <source>Bring back %n captures</source>
        <translation>
            <numerusform>%n Aufnahme zurückholen</numerusform>
            <numerusform>%n Aufnahmen zurückholen</numerusform>
        </translation>
    </message>
    <message>
        <source>Bring back</source>
        <translation>Zurückholen</translation>
    </message>
    <message numerus="yes">
        <source>Exclude %n captures …</source>
        <translation>
            <numerusform>%n Aufnahme ausschließen …</numerusform>
            <numerusform>%n Aufnahmen ausschließen …</numerusform>
        </translation>
    </message>
    <message>
        <source>Exclude …</source>
        <translation>Ausschließen …</translation>
    </message>
    <message>
        <source>Why is this left out? The report will say so.</source>
        <translation>Warum wird das ausgelassen? Der Bericht nennt den Grund.</translation>
    </message>
</context>
<context>
    <name>JobRunner</name>
    <message>
        <source>Internal error, please report it: %1</source>
        <translation>Interner Fehler, bitte melden: %1</translation>
    </message>
</context>
<context>
    <name>MachineBodies</name>
    <message>
        <source>%1 bearing</source>
        <translation>Lager %1</translation>
    </message>
    <message>
        <source>%1 slide</source>
        <translation>Schlitten %1</translation>
    </message>
    <message>
        <source>%1 swivel</source>
        <translation>Schwenkachse %1</translation>
    </message>
    <message>
        <source>%1 turning table</source>
        <translation>Drehtisch %1</translation>
    </message>
    <message>
        <source>Bed</source>
        <translation>Bett</translation>
    </message>
    <message>
        <source>Column</source>
        <translation>Ständer</translation>
    </message>
    <message>
        <source>Crossbeam</source>
        <translation>Querbalken</translation>
    </message>
    <message>
        <source>Head</source>
        <translation>Spindelkopf</translation>
    </message>
    <message>
        <source>Spindle</source>
        <translation>Spindel</translation>
    </message>
    <message>
        <source>Table</source>
        <translation>Tisch</translation>
    </message>
    <message>
        <source>Tool</source>
        <translation>Werkzeug</translation>
    </message>
</context>
<context>
    <name>Print</name>
    <message>
        <source>Nothing can be printed to &quot;%1&quot;.</source>
        <translation>Auf „%1“ kann nicht gedruckt werden.</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>Export the table</source>
        <translation>Tabelle exportieren</translation>
    </message>
    <message>
        <source>Table (*.csv)</source>
        <translation>Tabelle (*.csv)</translation>
    </message>
    <message>
        <source>Copy with headers</source>
        <translation>Mit Überschriften kopieren</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Kopieren</translation>
    </message>
    <message>
        <source>Select all</source>
        <translation>Alles auswählen</translation>
    </message>
    <message>
        <source>Export as CSV …</source>
        <translation>Als CSV exportieren …</translation>
    </message>
    <message>
        <source>Sort by %1, smallest first</source>
        <translation>Nach %1 sortieren, kleinste zuerst</translation>
    </message>
    <message>
        <source>Sort by %1, largest first</source>
        <translation>Nach %1 sortieren, größte zuerst</translation>
    </message>
    <message>
        <source>As the page lists them</source>
        <translation>In der Reihenfolge der Seite</translation>
    </message>
</context>
<context>
    <name>Question</name>
    <message>
        <source>Do not ask again</source>
        <translation>Nicht mehr nachfragen</translation>
    </message>
</context>
<context>
    <name>SelfTest</name>
    <message>
        <source>%1 MB in use after all demos, at most %2 MB</source>
        <translation>%1 MB belegt nach allen Demos, höchstens %2 MB</translation>
    </message>
    <message>
        <source>%1 deviations, %2 % within three standard uncertainties of the truth, rms error %3 µm</source>
        <translation>%1 Abweichungen, %2 % innerhalb von drei Standardunsicherheiten der Wahrheit, rms-Fehler %3 µm</translation>
    </message>
    <message>
        <source>%1 did not finish</source>
        <translation>%1 wurde nicht fertig</translation>
    </message>
    <message>
        <source>%1 has no page</source>
        <translation>%1 hat keine Seite</translation>
    </message>
    <message>
        <source>hidden: %1; named: %2</source>
        <translation>verborgen: %1; benannt: %2</translation>
    </message>
    <message>
        <source>nothing</source>
        <translation>nichts</translation>
    </message>
    <message>
        <source>the captures were not evaluated</source>
        <translation>die Aufnahmen wurden nicht ausgewertet</translation>
    </message>
    <message>
        <source>the demo could not be made: %1</source>
        <translation>die Demo ließ sich nicht anlegen: %1</translation>
    </message>
    <message>
        <source>the discrepancy was not searched</source>
        <translation>die Diskrepanz wurde nicht gesucht</translation>
    </message>
</context>
<context>
    <name>SimulationPanel</name>
    <message>
        <source>An empty folder</source>
        <translation>Ein leerer Ordner</translation>
    </message>
    <message>
        <source>CalculiX</source>
        <translation>CalculiX</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>It is run inside Spindrift: no other program is started.</source>
        <translation>Läuft in Spindrift selbst: kein anderes Programm wird gestartet.</translation>
    </message>
    <message>
        <source>New folder</source>
        <translation>Neuer Ordner</translation>
    </message>
    <message>
        <source>Nothing is run: the table says what each parameter changes.</source>
        <translation>Nichts wird ausgeführt: die Tabelle sagt, was jeder Parameter ändert.</translation>
    </message>
    <message>
        <source>Nothing is started before you press one of the buttons above.</source>
        <translation>Nichts wird gestartet, bevor eine der Schaltflächen oben gedrückt wird.</translation>
    </message>
    <message>
        <source>Program that will be run, each time in a folder of its own: %1.</source>
        <translation>Programm, das in einem eigenen Ordner ausgeführt wird: %1.</translation>
    </message>
    <message>
        <source>Programs that will be run, each time in a folder of their own: %1.</source>
        <translation>Programme, die jeweils in einem eigenen Ordner ausgeführt werden: %1.</translation>
    </message>
    <message>
        <source>Put it in</source>
        <translation>Einsetzen</translation>
    </message>
    <message>
        <source>Put it into the simulation</source>
        <translation>In die Simulation einsetzen</translation>
    </message>
    <message>
        <source>The simulator is run until its parameters fit what was measured. Its new version is written to a new folder; the present one stays as it is.</source>
        <translation>Der Simulator läuft, bis seine Parameter zur Messung passen. Seine neue Version wird in einen neuen Ordner geschrieben; die jetzige bleibt, wie sie ist.</translation>
    </message>
    <message>
        <source>a program with templates</source>
        <translation>ein Programm mit Vorlagen</translation>
    </message>
    <message>
        <source>scenario of the virtual machine</source>
        <translation>Szenario der virtuellen Maschine</translation>
    </message>
    <message>
        <source>table of sensitivities</source>
        <translation>Tabelle der Empfindlichkeiten</translation>
    </message>
    <message>
        <source>Browse …</source>
        <translation>Durchsuchen …</translation>
    </message>
</context>
<context>
    <name>Tasks</name>
    <message>
        <source>%1: stopped, because another campaign was chosen. What was finished is stored.</source>
        <translation>%1: angehalten, weil eine andere Kampagne gewählt wurde. Was fertig war, ist gespeichert.</translation>
    </message>
    <message>
        <source>Running what is outdated</source>
        <translation>Veraltetes wird ausgeführt</translation>
    </message>
</context>
<context>
    <name>VerifyPage</name>
    <message>
        <source>After, ± 2 uncertainties</source>
        <translation>Nachher, ± 2 Unsicherheiten</translation>
    </message>
    <message>
        <source>Before, ± 2 uncertainties</source>
        <translation>Vorher, ± 2 Unsicherheiten</translation>
    </message>
    <message>
        <source>Change of %1 / %2</source>
        <translation>Änderung von %1 / %2</translation>
    </message>
    <message>
        <source>Goal</source>
        <translation>Ziel</translation>
    </message>
    <message>
        <source>Measured value, points in order of the plan</source>
        <translation>Messwert, Punkte in der Reihenfolge des Plans</translation>
    </message>
    <message>
        <source>Thermal state, in order of the plan</source>
        <translation>Thermischer Zustand, in der Reihenfolge des Plans</translation>
    </message>
    <message>
        <source>µm</source>
        <translation>µm</translation>
    </message>
    <message>
        <source>µrad</source>
        <translation>µrad</translation>
    </message>
    <message>
        <source>After, range over the points with ± 2 u</source>
        <translation>Nachher, Spanne über die Punkte mit ± 2 u</translation>
    </message>
    <message>
        <source>Before, range over the points with ± 2 u</source>
        <translation>Vorher, Spanne über die Punkte mit ± 2 u</translation>
    </message>
</context>
<context>
    <name>core</name>
    <message>
        <source> with status {}</source>
        <translation> mit Status {}</translation>
    </message>
    <message>
        <source> with {}</source>
        <translation> mit {}</translation>
    </message>
    <message>
        <source>$AA_ENC_COMP in mm: the deviation itself, {}, zero at the reference position; a positive value moves the axis in the negative direction. Add the values of a table that the control has. Measured from {:g} to {:g} mm; beyond that it is extrapolated.</source>
        <translation>$AA_ENC_COMP in mm: die Abweichung selbst, {}, null an der Referenzposition; ein positiver Wert bewegt die Achse in negative Richtung. Werte einer bereits vorhandenen Tabelle der Steuerung addieren. Gemessen von {:g} bis {:g} mm; darüber hinaus extrapoliert.</translation>
    </message>
    <message>
        <source>(another sensor may do as well)</source>
        <translation>(ein anderer Sensor taugt möglicherweise ebenso)</translation>
    </message>
    <message>
        <source>(bar at {:.2f} °C)</source>
        <translation>(Leiste bei {:.2f} °C)</translation>
    </message>
    <message>
        <source>(ex, ey, ez) = -g q n x (p - C centre), n along the axis of the turn</source>
        <translation>(ex, ey, ez) = -g q n x (p - C-Zentrum), n entlang der Drehachse</translation>
    </message>
    <message>
        <source>(ex, ey, ez) = g q n x (p - p0), n along the axis of the turn</source>
        <translation>(ex, ey, ez) = g q n x (p - p0), n entlang der Drehachse</translation>
    </message>
    <message>
        <source>(line {})</source>
        <translation>(Zeile {})</translation>
    </message>
    <message>
        <source>(not stable: another sensor may do as well)</source>
        <translation>(nicht stabil: ein anderer Sensor taugt möglicherweise ebenso)</translation>
    </message>
    <message>
        <source>(numbers seem to be written with a decimal comma)</source>
        <translation>(Zahlen sind anscheinend mit Dezimalkomma geschrieben)</translation>
    </message>
    <message>
        <source>(open combination: {})</source>
        <translation>(offene Kombination: {})</translation>
    </message>
    <message>
        <source>(temperature of the bar not known: taken as that of the certificate)</source>
        <translation>(Temperatur der Leiste nicht bekannt: als die des Kalibrierscheins angenommen)</translation>
    </message>
    <message>
        <source>(the first)</source>
        <translation>(die erste)</translation>
    </message>
    <message>
        <source>({:.0f}, {:.0f}, {:.0f}) mm</source>
        <translation>({:.0f}, {:.0f}, {:.0f}) mm</translation>
    </message>
    <message>
        <source>({} of {} are there)</source>
        <translation>({} von {} sind vorhanden)</translation>
    </message>
    <message>
        <source>({} so far)</source>
        <translation>(bisher {})</translation>
    </message>
    <message>
        <source>, about {:.0f} s</source>
        <translation>, etwa {:.0f} s</translation>
    </message>
    <message>
        <source>, about {} left</source>
        <translation>, etwa {} übrig</translation>
    </message>
    <message>
        <source>, all choices tried</source>
        <translation>, alle Möglichkeiten geprüft</translation>
    </message>
    <message>
        <source>, by exchange</source>
        <translation>, durch Austausch</translation>
    </message>
    <message>
        <source>, from {:.0f} s to {:.0f} s</source>
        <translation>, von {:.0f} s bis {:.0f} s</translation>
    </message>
    <message>
        <source>, most in</source>
        <translation>, am meisten in</translation>
    </message>
    <message>
        <source>, nothing works on it</source>
        <translation>, niemand arbeitet daran</translation>
    </message>
    <message>
        <source>, or an empty field where the value is missing</source>
        <translation>, oder ein leeres Feld, wo der Wert fehlt</translation>
    </message>
    <message>
        <source>, put in</source>
        <translation>, eingesetzt</translation>
    </message>
    <message>
        <source>, spindle up to {:g} rpm</source>
        <translation>, Spindel bis {:g} rpm</translation>
    </message>
    <message>
        <source>, time constant {:.0f} min</source>
        <translation>, Zeitkonstante {:.0f} min</translation>
    </message>
    <message>
        <source>, with the instrument off until the start,</source>
        <translation>, mit bis zum Beginn ausgeschaltetem Messgerät,</translation>
    </message>
    <message>
        <source>, with the table at its angles in turn</source>
        <translation>, mit dem Tisch nacheinander in seinen Winkeln</translation>
    </message>
    <message>
        <source>, {:g} to {:g} mm</source>
        <translation>, {:g} bis {:g} mm</translation>
    </message>
    <message>
        <source>, {} failed</source>
        <translation>, {} fehlgeschlagen</translation>
    </message>
    <message>
        <source>, {} lost</source>
        <translation>, {} verloren</translation>
    </message>
    <message>
        <source>, {} running</source>
        <translation>, {} laufend</translation>
    </message>
    <message>
        <source>, {} touches</source>
        <translation>, {} Antastungen</translation>
    </message>
    <message>
        <source>--axis &quot;{}&quot; is not a linear axis; allowed: X, Y, Z.</source>
        <translation>--axis „{}“ ist keine Linearachse; zulässig: X, Y, Z.</translation>
    </message>
    <message>
        <source>--context belongs to --update kalman; the other updates know no context.</source>
        <translation>--context gehört zu --update kalman; die anderen Nachführungen kennen keinen Kontext.</translation>
    </message>
    <message>
        <source>--interval must be positive, in s.</source>
        <translation>--interval muss positiv sein, in s.</translation>
    </message>
    <message>
        <source>--limit names {}, which is not among --outputs.</source>
        <translation>--limit nennt {}, das nicht unter --outputs steht.</translation>
    </message>
    <message>
        <source>--outputs names no error; allowed: columns separated by commas.</source>
        <translation>--outputs nennt keine Abweichung; zulässig: durch Kommas getrennte Spalten.</translation>
    </message>
    <message>
        <source>-1, 0 or 1</source>
        <translation>-1, 0 oder 1</translation>
    </message>
    <message>
        <source>0 for the first segment</source>
        <translation>0 für den ersten Abschnitt</translation>
    </message>
    <message>
        <source>0 or 1</source>
        <translation>0 oder 1</translation>
    </message>
    <message>
        <source>0.0001 to 0.01</source>
        <translation>0,0001 bis 0,01</translation>
    </message>
    <message>
        <source>0.1 to 600</source>
        <translation>0,1 bis 600</translation>
    </message>
    <message>
        <source>1 or 2</source>
        <translation>1 oder 2</translation>
    </message>
    <message>
        <source>1 to 65535</source>
        <translation>1 bis 65535</translation>
    </message>
    <message>
        <source>1 to {:.0f} of {}</source>
        <translation>1 bis {:.0f} von {}</translation>
    </message>
    <message>
        <source>7 or 8</source>
        <translation>7 oder 8</translation>
    </message>
    <message>
        <source>: another fiducial, or not at its position.</source>
        <translation>: eine andere Messmarke oder nicht an ihrer Position.</translation>
    </message>
    <message>
        <source>; 1 is taken over when its feature is complete</source>
        <translation>; 1 wird übernommen, wenn ihr Merkmal vollständig ist</translation>
    </message>
    <message>
        <source>; all styli see the sphere move alike, as thermal drift does</source>
        <translation>; alle Tastereinsätze sehen die Kugel gleich wandern, wie bei thermischer Drift</translation>
    </message>
    <message>
        <source>; it lies on {} (wrong or swapped feature?)</source>
        <translation>; sie liegt auf {} (falsches oder vertauschtes Merkmal?)</translation>
    </message>
    <message>
        <source>; its effective radius {:.4f} mm is far from {:.4f} mm of the machine file</source>
        <translation>; sein wirksamer Radius {:.4f} mm ist weit entfernt von {:.4f} mm der Maschinendatei</translation>
    </message>
    <message>
        <source>; measure {} at the start and after {} (h:min)</source>
        <translation>; zu Beginn und nach {1} (h:min) {0} messen</translation>
    </message>
    <message>
        <source>; the sphere moves smoothly from pass to pass, as thermal drift does</source>
        <translation>; die Kugel wandert stetig von Durchgang zu Durchgang, wie bei thermischer Drift</translation>
    </message>
    <message>
        <source>; these data do not distinguish at least one of them from its rivals</source>
        <translation>; diese Daten unterscheiden mindestens einen davon nicht von konkurrierenden Erklärungen</translation>
    </message>
    <message>
        <source>; without it the error in runs left out changes by {:+.0f} %</source>
        <translation>; ohne ihn ändert sich der Fehler in ausgelassenen Läufen um {:+.0f} %</translation>
    </message>
    <message>
        <source>; {} are taken over when their feature is complete</source>
        <translation>; {} werden übernommen, wenn ihr Merkmal vollständig ist</translation>
    </message>
    <message>
        <source>; {} of work</source>
        <translation>; {} Arbeit</translation>
    </message>
    <message>
        <source>; {} rounds of tasks brought no answer</source>
        <translation>; {} Runden von Aufgaben brachten keine Antwort</translation>
    </message>
    <message>
        <source>; {} to be taken again</source>
        <translation>; {} zu wiederholen</translation>
    </message>
    <message>
        <source>A Shewhart limit of</source>
        <translation>Eine Shewhart-Grenze von</translation>
    </message>
    <message>
        <source>A baseline of</source>
        <translation>Ein Basiszeitraum von</translation>
    </message>
    <message>
        <source>A campaign of scans needs at least one artefact and one cycle.</source>
        <translation>Eine Kampagne von Scans braucht mindestens einen Prüfkörper und einen Zyklus.</translation>
    </message>
    <message>
        <source>A certificate uncertainty of {:g} µm is implausibly large; check the unit.</source>
        <translation>Eine Unsicherheit des Kalibrierscheins von {:g} µm ist unplausibel groß; Einheit prüfen.</translation>
    </message>
    <message>
        <source>A compensation that is not a number is not written.</source>
        <translation>Eine Kompensation, die keine Zahl ist, wird nicht geschrieben.</translation>
    </message>
    <message>
        <source>A fitted term closes it to {:.2f} µm: the physics as they are do not close it as well{}.</source>
        <translation>Ein angepasster Term verringert sie auf {:.2f} µm: die Physik in der jetzigen Form schließt sie nicht so gut{}.</translation>
    </message>
    <message>
        <source>A gap must be longer than one spacing.</source>
        <translation>Eine Lücke muss länger als ein Punktabstand sein.</translation>
    </message>
    <message>
        <source>A limit of the compensator is negative or zero.</source>
        <translation>Eine Grenze des Kompensators ist negativ oder null.</translation>
    </message>
    <message>
        <source>A limit of the compensator is not finite.</source>
        <translation>Eine Grenze des Kompensators ist nicht endlich.</translation>
    </message>
    <message>
        <source>A log alone has no plan that could be measured again. Log the machine with the compensation on and open that log as a campaign of its own.</source>
        <translation>Ein Protokoll allein hat keinen Plan, der erneut gemessen werden könnte. Die Maschine mit eingeschalteter Kompensation protokollieren und dieses Protokoll als eigene Kampagne öffnen.</translation>
    </message>
    <message>
        <source>A log over time has no points to compare; Model compares models of it.</source>
        <translation>Ein Protokoll über der Zeit hat keine Punkte zum Vergleichen; „Modell“ vergleicht Modelle davon.</translation>
    </message>
    <message>
        <source>A private control cannot be made: {}: {}.</source>
        <translation>Eine eigene Steuerung lässt sich nicht anlegen: {}: {}.</translation>
    </message>
    <message>
        <source>A program is running.</source>
        <translation>Ein Programm läuft.</translation>
    </message>
    <message>
        <source>A serial line of {} baud is not supported.</source>
        <translation>Eine serielle Leitung mit {} Baud wird nicht unterstützt.</translation>
    </message>
    <message>
        <source>A significance of</source>
        <translation>Ein Signifikanzniveau von</translation>
    </message>
    <message>
        <source>A temperature difference across the column bends it about its base: the deviation grows with the square of the height above the base, the rotation in proportion to it.</source>
        <translation>Ein Temperaturunterschied über den Ständer biegt ihn um seinen Fuß: die Abweichung wächst mit dem Quadrat der Höhe über dem Fuß, die Drehung proportional dazu.</translation>
    </message>
    <message>
        <source>A worker cannot be started: no pipe.</source>
        <translation>Ein Arbeitsprozess lässt sich nicht starten: keine Pipe.</translation>
    </message>
    <message>
        <source>A worker cannot be started: too many processes.</source>
        <translation>Ein Arbeitsprozess lässt sich nicht starten: zu viele Prozesse.</translation>
    </message>
    <message>
        <source>After a night at rest</source>
        <translation>Nach einer Nacht im Stillstand</translation>
    </message>
    <message>
        <source>All captures are checked.</source>
        <translation>Alle Aufnahmen sind geprüft.</translation>
    </message>
    <message>
        <source>All {} captures of the plan are there.</source>
        <translation>Alle {} Aufnahmen des Plans sind vorhanden.</translation>
    </message>
    <message>
        <source>An EWMA limit of</source>
        <translation>Eine EWMA-Grenze von</translation>
    </message>
    <message>
        <source>An EWMA weight of</source>
        <translation>Ein EWMA-Gewicht von</translation>
    </message>
    <message>
        <source>An interval of {} days is not allowed; allowed: 0 (not said) to 36500.</source>
        <translation>Ein Intervall von {} Tagen ist nicht zulässig; zulässig: 0 (keine Angabe) bis 36500.</translation>
    </message>
    <message>
        <source>Angles of the profiler that the calibration leaves open ({}) make up to {:.2g} µm of the stated uncertainty of a displacement ({} in {}). An angle measured otherwise, such as with a dial indicator along the axis, goes into profiler.mounting_angles_rad of machine.json.</source>
        <translation>Winkel des Profilsensors, die die Kalibrierung offen lässt ({}), machen bis zu {:.2g} µm der angegebenen Unsicherheit einer Verschiebung aus ({} in {}). Ein anders gemessener Winkel, etwa mit einer Messuhr entlang der Achse, gehört in profiler.mounting_angles_rad von machine.json.</translation>
    </message>
    <message>
        <source>Artefact surface, mm</source>
        <translation>Fläche des Prüfkörpers, mm</translation>
    </message>
    <message>
        <source>As a height map the clouds do not fit ({}</source>
        <translation>Als Höhenkarte passen die Punktwolken nicht ({}</translation>
    </message>
    <message>
        <source>As in machine.json.</source>
        <translation>Wie in machine.json.</translation>
    </message>
    <message>
        <source>Axis {} is still moving ({:.0f} mm/min): wait until it stands still.</source>
        <translation>Achse {} bewegt sich noch ({:.0f} mm/min): warten, bis sie steht.</translation>
    </message>
    <message>
        <source>Ball {}</source>
        <translation>Kugel {}</translation>
    </message>
    <message>
        <source>Balls {} and {} are {:.4g} mm apart and run into each other; allowed: more than {:g} mm.</source>
        <translation>Die Kugeln {} und {} liegen {:.4g} mm auseinander und überschneiden sich; zulässig: mehr als {:g} mm.</translation>
    </message>
    <message>
        <source>Base below the lowest point: found {} mm; allowed: more than 0.</source>
        <translation>Sockel unter dem tiefsten Punkt: gefunden {} mm; zulässig: mehr als 0.</translation>
    </message>
    <message>
        <source>Batch {} was started with program version {}, this worker has {}; allowed: workers of the same version, for results of two versions do not mix.</source>
        <translation>Batch-Auftrag {} wurde mit Programmversion {} begonnen, dieser Arbeitsprozess hat {}; zulässig: Arbeitsprozesse derselben Version, denn Ergebnisse zweier Versionen werden nicht gemischt.</translation>
    </message>
    <message>
        <source>Before and after are compared.</source>
        <translation>Vorher und nachher sind verglichen.</translation>
    </message>
    <message>
        <source>C alone at {:g} rpm</source>
        <translation>C allein mit {:g} rpm</translation>
    </message>
    <message>
        <source>C at rest</source>
        <translation>C im Stillstand</translation>
    </message>
    <message>
        <source>C turning</source>
        <translation>C dreht</translation>
    </message>
    <message>
        <source>C-frame machining centre, finite elements: {}</source>
        <translation>C-Gestell-Bearbeitungszentrum, finite Elemente: {}</translation>
    </message>
    <message>
        <source>Calibration of the profiler: {}</source>
        <translation>Kalibrierung des Profilsensors: {}</translation>
    </message>
    <message>
        <source>Camera {} gives no stream.</source>
        <translation>Kamera {} liefert keinen Datenstrom.</translation>
    </message>
    <message>
        <source>Camera {} has no item &quot;{}&quot;; allowed: exposure_us, gain, width, height, frames and incomplete.</source>
        <translation>Kamera {} hat keinen Datenpunkt „{}“; zulässig: exposure_us, gain, width, height, frames und incomplete.</translation>
    </message>
    <message>
        <source>Camera {} is not there.</source>
        <translation>Kamera {} ist nicht vorhanden.</translation>
    </message>
    <message>
        <source>Camera {} sends no grey frames of 8 to 16 bits; set its pixel format to Mono8.</source>
        <translation>Kamera {} sendet keine Graubilder mit 8 bis 16 Bit; ihr Pixelformat auf Mono8 stellen.</translation>
    </message>
    <message>
        <source>Camera {}: {} {:g} is not possible; allowed: {:g} to {:g}.</source>
        <translation>Kamera {}: {} {:g} ist nicht möglich; zulässig: {:g} bis {:g}.</translation>
    </message>
    <message>
        <source>Camera {}: {}: {}.</source>
        <translation>Kamera {}: {}: {}.</translation>
    </message>
    <message>
        <source>Cannot be tried, because the drivers never leave zero in this log: {}.</source>
        <translation>Nicht prüfbar, weil die Antriebsgrößen in diesem Protokoll immer null sind: {}.</translation>
    </message>
    <message>
        <source>Cannot establish connection to the database.</source>
        <translation>Die Verbindung zur Datenbank lässt sich nicht herstellen.</translation>
    </message>
    <message>
        <source>Captures are evaluated.</source>
        <translation>Die Aufnahmen sind ausgewertet.</translation>
    </message>
    <message>
        <source>Centrifugal forces change the bearing contact and the diameter of the shaft, so the nose moves along Z with the square of the speed and without delay.</source>
        <translation>Fliehkräfte ändern Lagerberührung und Wellendurchmesser; die Spindelnase bewegt sich mit dem Quadrat der Drehzahl unverzögert entlang Z.</translation>
    </message>
    <message>
        <source>Changed since: {}. Run it again.</source>
        <translation>Geändert seitdem: {}. Erneut ausführen.</translation>
    </message>
    <message>
        <source>Check the captures.</source>
        <translation>Die Aufnahmen prüfen.</translation>
    </message>
    <message>
        <source>Check the scans.</source>
        <translation>Die Scans prüfen.</translation>
    </message>
    <message>
        <source>Check the touches.</source>
        <translation>Die Antastungen prüfen.</translation>
    </message>
    <message>
        <source>Check whether the instrument had settled.</source>
        <translation>Prüfen, ob das Messgerät eingelaufen war.</translation>
    </message>
    <message>
        <source>Complete: {} points in {} profiles.</source>
        <translation>Vollständig: {} Punkte in {} Profilen.</translation>
    </message>
    <message>
        <source>Configuration of the control: {} {:g}; allowed: {}.</source>
        <translation>Konfiguration der Steuerung: {} {:g}; zulässig: {}.</translation>
    </message>
    <message>
        <source>Coolant changes the temperature of table and structure while it flows; the tool shifts and comes back when it stops, not always at the same pace.</source>
        <translation>Kühlschmierstoff ändert die Temperatur von Tisch und Struktur, solange er fließt; das Werkzeug verlagert sich und kehrt zurück, wenn er stoppt, nicht immer gleich schnell.</translation>
    </message>
    <message>
        <source>Correction to add to the command: minus the deviation, {}.</source>
        <translation>Korrektur, die zum Sollwert zu addieren ist: minus die Abweichung, {}.</translation>
    </message>
    <message>
        <source>Correction to add to the command: minus the predicted deviation (actual minus commanded), {}.</source>
        <translation>Korrektur, die zum Sollwert zu addieren ist: minus die vorhergesagte Abweichung (Ist minus Soll), {}.</translation>
    </message>
    <message>
        <source>The compensation is calculated.</source>
        <translation>Die Kompensation ist berechnet.</translation>
    </message>
    <message>
        <source>Corrections at the measured points</source>
        <translation>Korrekturen an den gemessenen Punkten</translation>
    </message>
    <message>
        <source>Corrections on a grid</source>
        <translation>Korrekturen auf einem Gitter</translation>
    </message>
    <message>
        <source>Deviation, not correction: actual minus commanded, {}, zero at the reference position.</source>
        <translation>Abweichung, nicht Korrektur: Ist minus Soll, {}, null an der Referenzposition.</translation>
    </message>
    <message>
        <source>EA = g q, ey = -g q rz, ez = g q ry</source>
        <translation>EA = g q, ey = -g q rz, ez = g q ry</translation>
    </message>
    <message>
        <source>EB = g q, ex = g q rz, ez = -g q rx</source>
        <translation>EB = g q, ex = g q rz, ez = -g q rx</translation>
    </message>
    <message>
        <source>EX, EY, EZ, EA, EB or EC</source>
        <translation>EX, EY, EZ, EA, EB oder EC</translation>
    </message>
    <message>
        <source>Edited in this session.</source>
        <translation>In dieser Sitzung bearbeitet.</translation>
    </message>
    <message>
        <source>Engineering Unit</source>
        <translation>Engineering Unit</translation>
    </message>
    <message>
        <source>Entered by</source>
        <translation>Eingetragen von</translation>
    </message>
    <message>
        <source>Environmental variation (ETVE), µm or µrad</source>
        <translation>Umgebungsbedingte Abweichung (ETVE), µm oder µrad</translation>
    </message>
    <message>
        <source>Evaluate the captures first (Calibrate).</source>
        <translation>Zuerst die Aufnahmen auswerten (Kalibrieren).</translation>
    </message>
    <message>
        <source>Evaluate the captures.</source>
        <translation>Die Aufnahmen auswerten.</translation>
    </message>
    <message>
        <source>Evaluate the scans.</source>
        <translation>Die Scans auswerten.</translation>
    </message>
    <message>
        <source>Evaluate the touches.</source>
        <translation>Die Antastungen auswerten.</translation>
    </message>
    <message>
        <source>Expansion between both ends, axis {}</source>
        <translation>Ausdehnung zwischen beiden Enden, Achse {}</translation>
    </message>
    <message>
        <source>Facets of the STL: found {} mm; allowed: {:.3g} to {:.3g} mm for this artefact.</source>
        <translation>Facetten der STL-Datei: gefunden {} mm; zulässig: {:.3g} bis {:.3g} mm für diesen Prüfkörper.</translation>
    </message>
    <message>
        <source>Feed motion and the room heat the ball screw; it grows away from its fixed bearing and takes the nut with it.</source>
        <translation>Vorschubbewegung und Raum erwärmen den Kugelgewindetrieb; er wächst von seinem Festlager weg und nimmt die Mutter mit.</translation>
    </message>
    <message>
        <source>Fewer than 100 points are left after edges and outliers have been removed.</source>
        <translation>Nach dem Entfernen von Kanten und Ausreißern bleiben weniger als 100 Punkte.</translation>
    </message>
    <message>
        <source>Find the six errors of the axis.</source>
        <translation>Die sechs Abweichungen der Achse bestimmen.</translation>
    </message>
    <message>
        <source>Fit a model first.</source>
        <translation>Zuerst ein Modell anpassen.</translation>
    </message>
    <message>
        <source>Fit a model or add a missing effect to the simulation first.</source>
        <translation>Zuerst ein Modell anpassen oder einen fehlenden Effekt zur Simulation hinzufügen.</translation>
    </message>
    <message>
        <source>Fit the error model.</source>
        <translation>Das Fehlermodell anpassen.</translation>
    </message>
    <message>
        <source>Guideways, drives and the room heat the table, which grows away from its centre in both directions; measured points move outwards under the tool.</source>
        <translation>Führungen, Antriebe und Raum erwärmen den Tisch, der von seinem Zentrum in beide Richtungen wächst; gemessene Punkte wandern unter dem Werkzeug nach außen.</translation>
    </message>
    <message>
        <source>G{:g} is not allowed here</source>
        <translation>G{:g} ist hier nicht zulässig</translation>
    </message>
    <message>
        <source>G{} is not known here</source>
        <translation>G{} ist hier nicht bekannt</translation>
    </message>
    <message>
        <source>H1 to H{}</source>
        <translation>H1 bis H{}</translation>
    </message>
    <message>
        <source>HAL has no {}.</source>
        <translation>HAL hat kein {}.</translation>
    </message>
    <message>
        <source>HAL of LinuxCNC (halcmd) is not started.</source>
        <translation>HAL von LinuxCNC (halcmd) ist nicht gestartet.</translation>
    </message>
    <message>
        <source>HAL of LinuxCNC (halcmd) {}.</source>
        <translation>HAL von LinuxCNC (halcmd) {}.</translation>
    </message>
    <message>
        <source>HAL of LinuxCNC has no pin or signal &quot;{}&quot;.</source>
        <translation>HAL von LinuxCNC hat weder Pin noch Signal „{}“.</translation>
    </message>
    <message>
        <source>HAL of LinuxCNC refuses: {}.</source>
        <translation>HAL von LinuxCNC verweigert: {}.</translation>
    </message>
    <message>
        <source>Heat from outside (sun, door, radiator) warms one side of the machine for a while; nothing in the log shows it.</source>
        <translation>Wärme von außen (Sonne, Tür, Heizkörper) erwärmt eine Seite der Maschine eine Zeit lang; nichts im Protokoll zeigt es.</translation>
    </message>
    <message>
        <source>H{} at {:g} mm runs into H{} at {:g} mm; allowed: holes more than a diameter apart.</source>
        <translation>H{} bei {:g} mm überschneidet sich mit H{} bei {:g} mm; zulässig: Löcher mit mehr als einem Durchmesser Abstand.</translation>
    </message>
    <message>
        <source>ISO 230-1 component errors of {}</source>
        <translation>Komponentenabweichungen von {} nach ISO 230-1</translation>
    </message>
    <message>
        <source>Identify a model over time first (Model).</source>
        <translation>Zuerst ein Modell über der Zeit identifizieren (Modell).</translation>
    </message>
    <message>
        <source>Identify a model over time.</source>
        <translation>Ein Modell über der Zeit identifizieren.</translation>
    </message>
    <message>
        <source>In the test range the model is no better than the baselines.</source>
        <translation>Im Prüfbereich ist das Modell nicht besser als die Vergleichsmodelle.</translation>
    </message>
    <message>
        <source>Input {} has the scale {} and the power {}; allowed: finite and positive.</source>
        <translation>Eingang {} hat den Faktor {} und die Potenz {}; zulässig: endlich und positiv.</translation>
    </message>
    <message>
        <source>It cannot be decided whether the goal of {:g} {} is met: {}, and its expanded uncertainty (k = 2) reaches across the goal; measure more often or more precisely.</source>
        <translation>Ob das Ziel von {:g} {} erreicht ist, ist nicht entscheidbar: {}, und die erweiterte Messunsicherheit (k = 2) reicht über das Ziel; öfter oder genauer messen.</translation>
    </message>
    <message>
        <source>It cannot be read yet; waiting for the rest. {}</source>
        <translation>Noch nicht lesbar; es wird auf den Rest gewartet. {}</translation>
    </message>
    <message>
        <source>It has the same content as {}.</source>
        <translation>Derselbe Inhalt wie {}.</translation>
    </message>
    <message>
        <source>Calculation in progress.</source>
        <translation>Berechnung läuft.</translation>
    </message>
    <message>
        <source>It is being written: {} bytes so far.</source>
        <translation>Wird gerade geschrieben: bisher {} Bytes.</translation>
    </message>
    <message>
        <source>Not an image, point cloud or touch list.</source>
        <translation>Kein Bild, keine Punktwolke und keine Antastliste.</translation>
    </message>
    <message>
        <source>It is there already.</source>
        <translation>Schon vorhanden.</translation>
    </message>
    <message>
        <source>It vanished or was renamed before it was complete.</source>
        <translation>Verschwunden oder umbenannt, bevor vollständig.</translation>
    </message>
    <message>
        <source>Its last line is not whole.</source>
        <translation>Die letzte Zeile ist nicht vollständig.</translation>
    </message>
    <message>
        <source>Known angle of the mounting: found {} ± {} rad; allowed: within 0.5 rad, with an uncertainty above 0.</source>
        <translation>Bekannter Anbauwinkel: gefunden {} ± {} rad; zulässig: innerhalb 0,5 rad, mit einer Unsicherheit über 0.</translation>
    </message>
    <message>
        <source>Last measured</source>
        <translation>Zuletzt gemessen</translation>
    </message>
    <message>
        <source>Last verdict</source>
        <translation>Letztes Urteil</translation>
    </message>
    <message>
        <source>Late values stay in {}: {} cannot be written.</source>
        <translation>Späte Werte bleiben in {}: {} kann nicht geschrieben werden.</translation>
    </message>
    <message>
        <source>Late values stay in {}: {}.</source>
        <translation>Späte Werte bleiben in {}: {}.</translation>
    </message>
    <message>
        <source>Left out, because the shape is zero at every point observed: {}.</source>
        <translation>Ausgelassen, weil die Form an jedem beobachteten Punkt null ist: {}.</translation>
    </message>
    <message>
        <source>Limits of the compensation: {} is {:g}; allowed: above zero.</source>
        <translation>Grenzen der Kompensation: {} ist {:g}; zulässig: über null.</translation>
    </message>
    <message>
        <source>LinuxCNC at {}:{}</source>
        <translation>LinuxCNC an {}:{}</translation>
    </message>
    <message>
        <source>LinuxCNC is not installed here (package linuxcnc-uspace)</source>
        <translation>LinuxCNC ist hier nicht installiert (Paket linuxcnc-uspace)</translation>
    </message>
    <message>
        <source>LinuxCNC screw compensation of {}</source>
        <translation>LinuxCNC-Spindelsteigungskompensation von {}</translation>
    </message>
    <message>
        <source>LinuxCNC screw compensation of {}, as a trim</source>
        <translation>LinuxCNC-Spindelsteigungskompensation von {}, als Trimm</translation>
    </message>
    <message>
        <source>Available at any time.</source>
        <translation>Jederzeit einsehbar.</translation>
    </message>
    <message>
        <source>Machine of the plant, as of {}</source>
        <translation>Maschine des Werks, Stand {}</translation>
    </message>
    <message>
        <source>Mask: found &apos;{}&apos;; allowed: {}.</source>
        <translation>Maske: gefunden &apos;{}&apos;; zulässig: {}.</translation>
    </message>
    <message>
        <source>Measure again with the compensation on.</source>
        <translation>Mit eingeschalteter Kompensation erneut messen.</translation>
    </message>
    <message>
        <source>Measurement and simulation agree within the noise.</source>
        <translation>Messung und Simulation stimmen innerhalb des Rauschens überein.</translation>
    </message>
    <message>
        <source>Measurement and simulation differ by no more than a rough simulation may be off by; nothing is missing beyond that.</source>
        <translation>Messung und Simulation unterscheiden sich nicht mehr, als eine grobe Simulation abweichen darf; darüber hinaus fehlt nichts.</translation>
    </message>
    <message>
        <source>Missing in the simulation: {}{}.</source>
        <translation>In der Simulation fehlt: {}{}.</translation>
    </message>
    <message>
        <source>Model of {} of state {} against {}</source>
        <translation>Modell von {} des Zustands {} gegen {}</translation>
    </message>
    <message>
        <source>M{:g} is not allowed here</source>
        <translation>M{:g} ist hier nicht zulässig</translation>
    </message>
    <message>
        <source>NDT, ICP and generalised ICP know only rigid clouds; allowed scan model: rigid.</source>
        <translation>NDT, ICP und verallgemeinertes ICP kennen nur starre Punktwolken; zulässiges Scanmodell: rigid.</translation>
    </message>
    <message>
        <source>Nine-parameter model of state {} against {}</source>
        <translation>Neun-Parameter-Modell des Zustands {} gegen {}</translation>
    </message>
    <message>
        <source>No captures yet.</source>
        <translation>Noch keine Aufnahmen.</translation>
    </message>
    <message>
        <source>No change that is more than chance</source>
        <translation>Keine Änderung, die mehr als Zufall ist</translation>
    </message>
    <message>
        <source>No component has a goal: nothing was judged.</source>
        <translation>Keine Komponente hat ein Ziel: nichts wurde beurteilt.</translation>
    </message>
    <message>
        <source>No effect has been added to the simulation yet.</source>
        <translation>Zur Simulation wurde noch kein Effekt hinzugefügt.</translation>
    </message>
    <message>
        <source>No file was given.</source>
        <translation>Es wurde keine Datei angegeben.</translation>
    </message>
    <message>
        <source>No folder for a run can be made in {}: {}.</source>
        <translation>In {} lässt sich kein Ordner für einen Lauf anlegen: {}.</translation>
    </message>
    <message>
        <source>Without a log of what the machine did meanwhile, its own thermal drift and a drift of the instrument cannot be separated; {}.</source>
        <translation>Ohne Protokoll dessen, was die Maschine inzwischen tat, sind ihre eigene thermische Drift und eine Drift des Messgeräts nicht trennbar; {}.</translation>
    </message>
    <message>
        <source>No mechanism of the simulation causes what was named: {}</source>
        <translation>Kein Mechanismus der Simulation verursacht das Benannte: {}</translation>
    </message>
    <message>
        <source>No model of {}: {}</source>
        <translation>Kein Modell von {}: {}</translation>
    </message>
    <message>
        <source>No options were given, or their struct_size is not set.</source>
        <translation>Es wurden keine Optionen angegeben, oder ihr struct_size ist nicht gesetzt.</translation>
    </message>
    <message>
        <source>No parameter of {} is said to cause {}: it stays a fitted term; allowed: a parameter with this id among its &quot;effects&quot;.</source>
        <translation>Kein Parameter von {} verursacht laut Angabe {}: es bleibt ein angepasster Term; zulässig: ein Parameter mit dieser Kennung unter seinen &quot;effects&quot;.</translation>
    </message>
    <message>
        <source>No pattern of {} has a place {{{}}}.</source>
        <translation>Kein Muster von {} hat einen Platzhalter {{{}}}.</translation>
    </message>
    <message>
        <source>No plant store is named; allowed: a file such as plant.sqlite, or postgresql:host=NAME dbname=plant user=NAME.</source>
        <translation>Es ist keine Werksdatenbank angegeben; zulässig: eine Datei wie plant.sqlite oder postgresql:host=NAME dbname=plant user=NAME.</translation>
    </message>
    <message>
        <source>No scan could be compared with a reference: at least two usable scans of one artefact are needed.</source>
        <translation>Kein Scan konnte mit einer Referenz verglichen werden: nötig sind mindestens zwei brauchbare Scans eines Prüfkörpers.</translation>
    </message>
    <message>
        <source>No structure is in view.</source>
        <translation>Es ist keine Struktur im Bild.</translation>
    </message>
    <message>
        <source>No uncertainty is stated: the target is not a height map.</source>
        <translation>Es wird keine Unsicherheit angegeben: das Ziel ist keine Höhenkarte.</translation>
    </message>
    <message>
        <source>Nominal, forward, reverse in mm (COMP_FILE_TYPE = 0): where the axis really is; LinuxCNC subtracts by itself. {}{}. Measured from {:g} to {:g} mm; beyond that it is extrapolated.</source>
        <translation>Soll, vorwärts, rückwärts in mm (COMP_FILE_TYPE = 0): wo die Achse wirklich steht; LinuxCNC subtrahiert selbst. {}{}. Gemessen von {:g} bis {:g} mm; darüber hinaus extrapoliert.</translation>
    </message>
    <message>
        <source>Nominal, forward, reverse in mm (COMP_FILE_TYPE = 1): minus the deviation, added to the motor&apos;s command. The same compensation in the control&apos;s other form; only one of the two files may be loaded.</source>
        <translation>Soll, vorwärts, rückwärts in mm (COMP_FILE_TYPE = 1): minus die Abweichung, zum Sollwert des Motors addiert. Dieselbe Kompensation in der anderen Form der Steuerung; nur eine der beiden Dateien darf geladen werden.</translation>
    </message>
    <message>
        <source>Not all values could be tried; what is found keeps to those that could. {}</source>
        <translation>Nicht alle Werte konnten geprüft werden; das Ergebnis beschränkt sich auf die prüfbaren. {}</translation>
    </message>
    <message>
        <source>Not to be decided, because the log lacks what drives {}: {}.</source>
        <translation>Nicht entscheidbar, weil dem Protokoll fehlt, was {} antreibt: {}.</translation>
    </message>
    <message>
        <source>Nothing was named: there is nothing to put into the simulation.</source>
        <translation>Es wurde nichts benannt: es gibt nichts in die Simulation einzusetzen.</translation>
    </message>
    <message>
        <source>Now {}: {}</source>
        <translation>Jetzt {}: {}</translation>
    </message>
    <message>
        <source>One campaign cannot be compared; allowed: two or more.</source>
        <translation>Eine einzelne Kampagne lässt sich nicht vergleichen; zulässig: zwei oder mehr.</translation>
    </message>
    <message>
        <source>Only {:.0f} % of the points of the fullest scan of {}: cut short or hidden.</source>
        <translation>Nur {:.0f} % der Punkte des vollsten Scans von {}: abgeschnitten oder verdeckt.</translation>
    </message>
    <message>
        <source>Only {:.0f} % of the reference is seen as it was (the rest is cut short or hidden by something), too little for the registration to settle.</source>
        <translation>Nur {:.0f} % der Referenz sind unverändert zu sehen (der Rest ist abgeschnitten oder verdeckt), zu wenig für eine Konvergenz der Registrierung.</translation>
    </message>
    <message>
        <source>Only {:.0f} of {} points of the rim lie on one circle.</source>
        <translation>Nur {:.0f} von {} Punkten des Randes liegen auf einem Kreis.</translation>
    </message>
    <message>
        <source>Only {:.1f} % of the surface is flatter than the slope of {} that the profiler sees.</source>
        <translation>Nur {:.1f} % der Fläche sind flacher als die Steigung {}, die der Profilsensor erfasst.</translation>
    </message>
    <message>
        <source>Only {} points of the scan and {} of the reference lie apart; at least {} are needed.</source>
        <translation>Nur {} Punkte des Scans und {} der Referenz liegen auseinander; mindestens {} sind nötig.</translation>
    </message>
    <message>
        <source>Only {} was observed: effects that differ in other components alone cannot be distinguished.</source>
        <translation>Nur {} wurde beobachtet: Effekte, die sich allein in anderen Komponenten unterscheiden, sind nicht trennbar.</translation>
    </message>
    <message>
        <source>Order of the drift: found {}; allowed: 0 to 2.</source>
        <translation>Ordnung der Drift: gefunden {}; zulässig: 0 bis 2.</translation>
    </message>
    <message>
        <source>Out of focus: edges are blurred by {:.1f} px, allowed are {:.1f} px.</source>
        <translation>Unscharf: Kanten sind um {:.1f} px verwischt, zulässig sind {:.1f} px.</translation>
    </message>
    <message>
        <source>Output {} has a gain of {} with a time constant of {} s; allowed: finite numbers, no negative time constant (it would be unstable).</source>
        <translation>Ausgang {} hat eine Verstärkung {} mit einer Zeitkonstante von {} s; zulässig: endliche Zahlen, keine negative Zeitkonstante (er wäre instabil).</translation>
    </message>
    <message>
        <source>Output {} has no terms, only a constant (an ARX model with complex, negative or double poles has no equivalent in first-order time constants); allowed: a model identified with --method response or oe.</source>
        <translation>Ausgang {} hat keine Terme, nur eine Konstante (ein ARX-Modell mit komplexen, negativen oder doppelten Polen hat keine Entsprechung in Zeitkonstanten erster Ordnung); zulässig: ein mit --method response oder oe identifiziertes Modell.</translation>
    </message>
    <message>
        <source>Output {} has the unit &quot;{}&quot;; allowed: &quot;um&quot; or &quot;urad&quot;.</source>
        <translation>Ausgang {} hat die Einheit „{}“; zulässig: &quot;um&quot; oder &quot;urad&quot;.</translation>
    </message>
    <message>
        <source>Output {} uses input {}, which the model does not have.</source>
        <translation>Ausgang {} verwendet Eingang {}, den das Modell nicht hat.</translation>
    </message>
    <message>
        <source>PCL reports no convergence.</source>
        <translation>PCL meldet keine Konvergenz.</translation>
    </message>
    <message>
        <source>PLY has no compressed form; allowed: ascii, binary.</source>
        <translation>PLY hat keine komprimierte Form; zulässig: ascii, binary.</translation>
    </message>
    <message>
        <source>Places per side: found {}; allowed: 10 to 5000.</source>
        <translation>Stellen je Seite: gefunden {}; zulässig: 10 bis 5000.</translation>
    </message>
    <message>
        <source>Play between nut and screw: the axis stops on the side from which it came.</source>
        <translation>Spiel zwischen Spindel und Mutter: die Achse hält auf der Seite, von der sie kam.</translation>
    </message>
    <message>
        <source>Point {} of {} is not finite ({}, {}, {}); allowed: finite coordinates in mm.</source>
        <translation>Punkt {} von {} ist nicht endlich ({}, {}, {}); zulässig: endliche Koordinaten in mm.</translation>
    </message>
    <message>
        <source>Rotating spindle, µm or µrad</source>
        <translation>Drehende Spindel, µm oder µrad</translation>
    </message>
    <message>
        <source>Run the compensator over the log.</source>
        <translation>Den Kompensator über das Protokoll laufen lassen.</translation>
    </message>
    <message>
        <source>Scan model &apos;{}&apos; is not known; allowed: rigid, push_broom.</source>
        <translation>Scanmodell &apos;{}&apos; ist nicht bekannt; zulässig: rigid, push_broom.</translation>
    </message>
    <message>
        <source>Search for what the simulation lacks.</source>
        <translation>Suchen, was in der Simulation fehlt.</translation>
    </message>
    <message>
        <source>Separate the errors in every cycle.</source>
        <translation>Die Abweichungen in jedem Zyklus trennen.</translation>
    </message>
    <message>
        <source>Sharpness {:.3f}, {} decoded.</source>
        <translation>Schärfe {:.3f}, {} decodiert.</translation>
    </message>
    <message>
        <source>Sharpness {:.3f}.</source>
        <translation>Schärfe {:.3f}.</translation>
    </message>
    <message>
        <source>Siemens measuring system error compensation of {}</source>
        <translation>Siemens-Messsystemfehlerkompensation von {}</translation>
    </message>
    <message>
        <source>Simulation completed by {}</source>
        <translation>Simulation ergänzt um {}</translation>
    </message>
    <message>
        <source>Slurm did not take the batch: sbatch said nothing but an error; see above.</source>
        <translation>Slurm nahm den Batch-Auftrag nicht an: sbatch meldete nur einen Fehler; siehe oben.</translation>
    </message>
    <message>
        <source>Slurm did not take the batch: {} Nothing is lost: start it again, or with --engine local.</source>
        <translation>Slurm nahm den Batch-Auftrag nicht an: {} Nichts ist verloren: erneut starten oder mit --engine local.</translation>
    </message>
    <message>
        <source>Slurm has not answered for {:.0f} min (squeue). Nothing is lost: batch resume {} --engine slurm goes on.</source>
        <translation>Slurm antwortet seit {:.0f} min nicht (squeue). Nichts ist verloren: batch resume {} --engine slurm setzt fort.</translation>
    </message>
    <message>
        <source>Something disagrees that no effect of the catalogue explains.</source>
        <translation>Es besteht ein Unterschied, den kein Effekt des Katalogs erklärt.</translation>
    </message>
    <message>
        <source>Something disagrees; no effect was tried.</source>
        <translation>Es besteht ein Unterschied; kein Effekt wurde geprüft.</translation>
    </message>
    <message>
        <source>Something is missing, and no effect of the catalogue explains it.</source>
        <translation>Es fehlt etwas, und kein Effekt des Katalogs erklärt es.</translation>
    </message>
    <message>
        <source>Sparkplug {}</source>
        <translation>Sparkplug {}</translation>
    </message>
    <message>
        <source>Spindle heat enters the structure where the head stands; the same heat moves the tool along Z more or less, depending on where this axis stood while it was heated.</source>
        <translation>Spindelwärme dringt dort in die Struktur ein, wo der Kopf steht; dieselbe Wärme bewegt das Werkzeug mehr oder weniger entlang Z, je nachdem, wo diese Achse beim Erwärmen stand.</translation>
    </message>
    <message>
        <source>Spindle heat warms one side of the head more than the other; the head tilts about a pivot and carries the tool point with it, sideways and in height.</source>
        <translation>Spindelwärme erwärmt eine Seite des Spindelkopfs stärker als die andere; der Kopf neigt sich um einen Drehpunkt und nimmt den Werkzeugpunkt seitlich und in der Höhe mit.</translation>
    </message>
    <message>
        <source>State &apos;{}&apos; is not among the observations; allowed: one of {}.</source>
        <translation>Zustand &apos;{}&apos; ist nicht unter den Beobachtungen; zulässig: einer von {}.</translation>
    </message>
    <message>
        <source>Steepest slope: found {}; allowed: more than 0.</source>
        <translation>Größte Steigung: gefunden {}; zulässig: mehr als 0.</translation>
    </message>
    <message>
        <source>Stylus {}</source>
        <translation>Tastereinsatz {}</translation>
    </message>
    <message>
        <source>Take again: {}</source>
        <translation>Wiederholen: {}</translation>
    </message>
    <message>
        <source>Take {} again: {}</source>
        <translation>{} wiederholen: {}</translation>
    </message>
    <message>
        <source>The address {}</source>
        <translation>Die Adresse {}</translation>
    </message>
    <message>
        <source>The angle between X and Y changes with the temperature of the guideways: X drifts in proportion to Y.</source>
        <translation>Der Winkel zwischen X und Y ändert sich mit der Temperatur der Führungen: X driftet proportional zu Y.</translation>
    </message>
    <message>
        <source>The artefact</source>
        <translation>Der Prüfkörper</translation>
    </message>
    <message>
        <source>The artefact has no balls; allowed: one or more, four to separate its errors.</source>
        <translation>Der Prüfkörper hat keine Kugeln; zulässig: eine oder mehr, vier zum Trennen seiner Abweichungen.</translation>
    </message>
    <message>
        <source>The artefact warms with the table or the room and grows away from its reference feature.</source>
        <translation>Der Prüfkörper erwärmt sich mit dem Tisch oder dem Raum und wächst von seinem Referenzmerkmal weg.</translation>
    </message>
    <message>
        <source>The artefact&apos;s corner lies at {} = {:g} mm; allowed: the travel, {:g} to {:g} mm.</source>
        <translation>Die Ecke des Prüfkörpers liegt bei {} = {:g} mm; zulässig: der Verfahrweg, {:g} bis {:g} mm.</translation>
    </message>
    <message>
        <source>The ball of stylus {} ({:g} mm) does not enter a hole of {:g} mm.</source>
        <translation>Die Kugel des Tastereinsatzes {} ({:g} mm) passt nicht in ein Loch von {:g} mm.</translation>
    </message>
    <message>
        <source>The ball screw is warmer where the nut travels, so its growth rises faster than in proportion to the distance from the fixed bearing.</source>
        <translation>Der Kugelgewindetrieb ist dort wärmer, wo die Mutter fährt; seine Ausdehnung steigt daher schneller als proportional zum Abstand vom Festlager.</translation>
    </message>
    <message>
        <source>The bar has no holes; allowed: one or more, three to separate its errors.</source>
        <translation>Die Leiste hat keine Löcher; zulässig: eines oder mehr, drei zum Trennen ihrer Abweichungen.</translation>
    </message>
    <message>
        <source>The bar is only {:.3g} mm long. Are these inches? Allowed are millimetres.</source>
        <translation>Die Leiste ist nur {:.3g} mm lang. Sind das Zoll? Zulässig sind Millimeter.</translation>
    </message>
    <message>
        <source>The beam warms unevenly over its height and sags between its ends; the head that travels on it follows the parabola and turns with its slope.</source>
        <translation>Der Querbalken erwärmt sich ungleichmäßig über seine Höhe und hängt zwischen seinen Enden durch; der darauf fahrende Kopf folgt der Parabel und neigt sich mit ihrer Steigung.</translation>
    </message>
    <message>
        <source>The campaign has no log.</source>
        <translation>Die Kampagne hat kein Protokoll.</translation>
    </message>
    <message>
        <source>The campaign holds finished observations.</source>
        <translation>Die Kampagne enthält fertige Beobachtungen.</translation>
    </message>
    <message>
        <source>The campaign is a log over time: no instrument to warm up.</source>
        <translation>Die Kampagne ist ein Protokoll über der Zeit: kein Messgerät, das warmlaufen müsste.</translation>
    </message>
    <message>
        <source>The campaign is a log over time: nothing to calibrate.</source>
        <translation>Die Kampagne ist ein Protokoll über der Zeit: nichts zu kalibrieren.</translation>
    </message>
    <message>
        <source>The campaign is a log over time: nothing to capture.</source>
        <translation>Die Kampagne ist ein Protokoll über der Zeit: nichts aufzunehmen.</translation>
    </message>
    <message>
        <source>The campaign {} of {} starts at {}, which is {:.0f} s after the clock of the plant store; set the clock of the computer that measured right, or start_utc in campaign.json. Nothing was stored.</source>
        <translation>Die Kampagne {} von {} beginnt um {}, das ist {:.0f} s nach der Uhr der Werksdatenbank; die Uhr des messenden Rechners richtig stellen oder start_utc in campaign.json. Nichts wurde gespeichert.</translation>
    </message>
    <message>
        <source>The certified place of {}</source>
        <translation>Die zertifizierte Lage von {}</translation>
    </message>
    <message>
        <source>The circle of the pocket must be four numbers x,y,z,r (mm).</source>
        <translation>Der Kreis der Tasche muss aus vier Zahlen x,y,z,r (mm) bestehen.</translation>
    </message>
    <message>
        <source>The clock of the log is {:.0f} s {} that of the observations, as far as the data show it (± {:.0f} s).</source>
        <translation>Die Uhr des Protokolls liegt {:.0f} s {} der Uhr der Beobachtungen, soweit die Daten es zeigen (± {:.0f} s).</translation>
    </message>
    <message>
        <source>The clock of this computer is {:.0f} s {} that of the plant store; set it right, or campaigns that start here get a wrong place in trends.</source>
        <translation>Die Uhr dieses Rechners liegt {:.0f} s {} der der Werksdatenbank; richtig stellen, sonst erhalten hier begonnene Kampagnen einen falschen Platz in Verläufen.</translation>
    </message>
    <message>
        <source>The cloud</source>
        <translation>Die Punktwolke</translation>
    </message>
    <message>
        <source>The clouds do not fit: root mean square distance {:.3g} mm.</source>
        <translation>Die Punktwolken passen nicht: mittlerer quadratischer Abstand {:.3g} mm.</translation>
    </message>
    <message>
        <source>The column warms as a whole and grows from its base: the head rises, more so the higher it stands on the column.</source>
        <translation>Der Ständer erwärmt sich als Ganzes und wächst von seinem Fuß aus: der Spindelkopf steigt, umso mehr, je höher er am Ständer steht.</translation>
    </message>
    <message>
        <source>The compensator cannot run this model: {}</source>
        <translation>Der Kompensator kann dieses Modell nicht ausführen: {}</translation>
    </message>
    <message>
        <source>The compensator was run over the log.</source>
        <translation>Der Kompensator wurde über das Protokoll ausgeführt.</translation>
    </message>
    <message>
        <source>The control did not come back within {:g} s: {}</source>
        <translation>Die Steuerung kam innerhalb von {:g} s nicht zurück: {}</translation>
    </message>
    <message>
        <source>The control does not start: {}</source>
        <translation>Die Steuerung startet nicht: {}</translation>
    </message>
    <message>
        <source>The control is in emergency stop: release it, then switch the machine on.</source>
        <translation>Die Steuerung ist im Not-Halt: entriegeln, dann die Maschine einschalten.</translation>
    </message>
    <message>
        <source>The control is not fit for a closed loop: {}: {}.</source>
        <translation>Die Steuerung ist für einen geschlossenen Regelkreis nicht geeignet: {}: {}.</translation>
    </message>
    <message>
        <source>The correlation length of the speckle noise must be at least 1 point.</source>
        <translation>Die Korrelationslänge des Speckle-Rauschens muss mindestens 1 Punkt betragen.</translation>
    </message>
    <message>
        <source>The cycle time must be positive.</source>
        <translation>Die Zykluszeit muss positiv sein.</translation>
    </message>
    <message>
        <source>The demonstration needs a control of its own: {}.</source>
        <translation>Die Vorführung braucht eine eigene Steuerung: {}.</translation>
    </message>
    <message>
        <source>The diameter of the holes</source>
        <translation>Der Durchmesser der Löcher</translation>
    </message>
    <message>
        <source>The diameter of {}</source>
        <translation>Der Durchmesser von {}</translation>
    </message>
    <message>
        <source>The direction of the bar</source>
        <translation>Die Richtung der Leiste</translation>
    </message>
    <message>
        <source>The direction of the bar is (0, 0, 0); allowed: a vector along the bar.</source>
        <translation>Die Richtung der Leiste ist (0, 0, 0); zulässig: ein Vektor entlang der Leiste.</translation>
    </message>
    <message>
        <source>The distance trimmed at an edge must not be negative (mm).</source>
        <translation>Der an einer Kante beschnittene Abstand darf nicht negativ sein (mm).</translation>
    </message>
    <message>
        <source>The drive of the rotary table heats its bearing and shifts the table.</source>
        <translation>Der Antrieb des Drehtisches erwärmt dessen Lager und verschiebt den Tisch.</translation>
    </message>
    <message>
        <source>The expansion coefficient</source>
        <translation>Der Ausdehnungskoeffizient</translation>
    </message>
    <message>
        <source>The finite-element program CalculiX (ccx) is not installed: install calculix-ccx.</source>
        <translation>Das Finite-Elemente-Programm CalculiX (ccx) ist nicht installiert: calculix-ccx installieren.</translation>
    </message>
    <message>
        <source>The first ball is the origin of the certificate; allowed: 0, 0, 0.</source>
        <translation>Die erste Kugel ist der Ursprung des Kalibrierscheins; zulässig: 0, 0, 0.</translation>
    </message>
    <message>
        <source>The fit of the pocket&apos;s rim did not settle.</source>
        <translation>Die Anpassung des Taschenrandes konvergierte nicht.</translation>
    </message>
    <message>
        <source>The fit of the simulator&apos;s parameters did not settle: nothing was put in.</source>
        <translation>Die Anpassung der Parameter des Simulators konvergierte nicht: nichts wurde eingesetzt.</translation>
    </message>
    <message>
        <source>The fixture of this point slipped once and stayed where it went.</source>
        <translation>Die Aufspannung dieses Punkts ist einmal gerutscht und blieb in der neuen Lage.</translation>
    </message>
    <message>
        <source>The gap {} does not shrink ({:.2f} µm before, {:.2f} µm after): nothing was put in.</source>
        <translation>Die Differenz {} wird nicht kleiner ({:.2f} µm vorher, {:.2f} µm nachher): nichts wurde eingesetzt.</translation>
    </message>
    <message>
        <source>The goal of {:g} {} is met: {}.</source>
        <translation>Das Ziel von {:g} {} ist erreicht: {}.</translation>
    </message>
    <message>
        <source>The goal of {:g} {} is not met: {}.</source>
        <translation>Das Ziel von {:g} {} ist nicht erreicht: {}.</translation>
    </message>
    <message>
        <source>The goal: {}</source>
        <translation>Das Ziel: {}</translation>
    </message>
    <message>
        <source>The height of a step must be positive (mm).</source>
        <translation>Die Höhe einer Stufe muss positiv sein (mm).</translation>
    </message>
    <message>
        <source>The identification called the model of {} not good enough ({}); allowed: a better model, or loading it by force.</source>
        <translation>Die Identifikation beurteilte das Modell von {} als nicht gut genug ({}); zulässig: ein besseres Modell oder erzwungenes Laden.</translation>
    </message>
    <message>
        <source>The image has too little contrast ({:.0f} grey levels). Increase the illumination or check for an obstructed lens.</source>
        <translation>Das Bild hat zu wenig Kontrast ({:.0f} Graustufen). Beleuchtung erhöhen oder prüfen, ob das Objektiv verdeckt ist.</translation>
    </message>
    <message>
        <source>The image is out of focus for its height of {:g} mm: sharpness {:.3f}, below it at {:g} mm {:.3f} and above it at {:g} mm {:.3f}.</source>
        <translation>Das Bild ist für seine Höhe von {:g} mm unscharf: Schärfe {:.3f}, darunter bei {:g} mm {:.3f} und darüber bei {:g} mm {:.3f}.</translation>
    </message>
    <message>
        <source>The image is out of focus for its height of {:g} mm: sharpness {:.3f}, {} of {} in {} has {:.3f} there.</source>
        <translation>Das Bild ist für seine Höhe von {:g} mm unscharf: Schärfe {:.3f}, {} von {} in {} hat dort {:.3f}.</translation>
    </message>
    <message>
        <source>The image is turned by {}°, {} {}° (against {} of {} in {}).</source>
        <translation>Das Bild ist um {}° gedreht, {} {}° (gegen {} von {} in {}).</translation>
    </message>
    <message>
        <source>The last line of {} was incomplete and was removed.</source>
        <translation>Die letzte Zeile von {} war unvollständig und wurde entfernt.</translation>
    </message>
    <message>
        <source>The least parts of overlap and agreement must lie between 0 and 1.</source>
        <translation>Die kleinsten Anteile von Überlappung und Übereinstimmung müssen zwischen 0 und 1 liegen.</translation>
    </message>
    <message>
        <source>The length over which errors change must be positive (mm).</source>
        <translation>Die Länge, über die sich Abweichungen ändern, muss positiv sein (mm).</translation>
    </message>
    <message>
        <source>The linear scale warms with the room and grows away from its datum; the axis follows the scale.</source>
        <translation>Das Längenmesssystem erwärmt sich mit dem Raum und wächst von seinem Nullpunkt weg; die Achse folgt dem Maßstab.</translation>
    </message>
    <message>
        <source>The log has a gap of {:.0f} s after {:.0f} s: what the machine did in it is not known, and {} observations between {:.0f} s and {:.0f} s, until its heat has gone, are not compared.</source>
        <translation>Das Protokoll hat eine Lücke von {:.0f} s nach {:.0f} s: was die Maschine darin tat, ist nicht bekannt, und {} Beobachtungen zwischen {:.0f} s und {:.0f} s, bis ihre Wärme abgeklungen ist, werden nicht verglichen.</translation>
    </message>
    <message>
        <source>The log has no spindle_rpm: spindle heat is known from temperatures at best.</source>
        <translation>Das Protokoll hat keine spindle_rpm: die Spindelwärme ist bestenfalls aus Temperaturen bekannt.</translation>
    </message>
    <message>
        <source>The machine has no X or no Y axis, so there is no heat map.</source>
        <translation>Die Maschine hat keine X- oder keine Y-Achse, daher gibt es keine Farbkarte.</translation>
    </message>
    <message>
        <source>The machine is not homed: home all axes.</source>
        <translation>Die Maschine ist nicht referenziert: alle Achsen referenzieren.</translation>
    </message>
    <message>
        <source>The machine is not switched on: it was not confirmed.</source>
        <translation>Die Maschine wird nicht eingeschaltet: es wurde nicht bestätigt.</translation>
    </message>
    <message>
        <source>The machine is off: switch it on.</source>
        <translation>Die Maschine ist aus: einschalten.</translation>
    </message>
    <message>
        <source>The machine is to run for {:g} s; allowed: above 0.</source>
        <translation>Die Maschine soll {:g} s laufen; zulässig: über 0.</translation>
    </message>
    <message>
        <source>The measuring instrument warms itself after it was switched on and drifts to its steady state; the machine has no part in it.</source>
        <translation>Das Messgerät erwärmt sich nach dem Einschalten und driftet in seinen Beharrungszustand; die Maschine ist daran nicht beteiligt.</translation>
    </message>
    <message>
        <source>The model has more than 1024 time constants.</source>
        <translation>Das Modell hat mehr als 1024 Zeitkonstanten.</translation>
    </message>
    <message>
        <source>The model has more than 32 input signals.</source>
        <translation>Das Modell hat mehr als 32 Eingangssignale.</translation>
    </message>
    <message>
        <source>The model has no output or more than 8.</source>
        <translation>Das Modell hat keinen oder mehr als 8 Ausgänge.</translation>
    </message>
    <message>
        <source>The model has too many inputs.</source>
        <translation>Das Modell hat zu viele Eingänge.</translation>
    </message>
    <message>
        <source>The model is fitted.</source>
        <translation>Das Modell ist angepasst.</translation>
    </message>
    <message>
        <source>The model is identified.</source>
        <translation>Das Modell ist identifiziert.</translation>
    </message>
    <message>
        <source>The model of campaign {} ({}) holds.</source>
        <translation>Das Modell der Kampagne {} ({}) gilt.</translation>
    </message>
    <message>
        <source>The model of campaign {} ({}) no longer holds: {}.</source>
        <translation>Das Modell der Kampagne {} ({}) gilt nicht mehr: {}.</translation>
    </message>
    <message>
        <source>The noise of the virtual profiler must not be negative (µm).</source>
        <translation>Das Rauschen des virtuellen Profilsensors darf nicht negativ sein (µm).</translation>
    </message>
    <message>
        <source>The normal distributions transform found no motion.</source>
        <translation>Die Transformation der Normalverteilungen (NDT) fand keine Bewegung.</translation>
    </message>
    <message>
        <source>The number of samples trimmed at an edge must not be negative.</source>
        <translation>Die Anzahl der an einer Kante beschnittenen Punkte darf nicht negativ sein.</translation>
    </message>
    <message>
        <source>The observations agree far better with the simulation of about {:.0f} min {} ({:.0f} % less scatter): compare the clocks of observations.csv, log.csv and the simulation.</source>
        <translation>Die Beobachtungen stimmen weit besser mit der Simulation von etwa {:.0f} min {} überein ({:.0f} % weniger Streuung): Uhren von observations.csv, log.csv und der Simulation vergleichen.</translation>
    </message>
    <message>
        <source>The offset of output {} is not finite.</source>
        <translation>Der Versatz des Ausgangs {} ist nicht endlich.</translation>
    </message>
    <message>
        <source>The offset of {}</source>
        <translation>Der Versatz von {}</translation>
    </message>
    <message>
        <source>The one capture of the plan is there.</source>
        <translation>Die eine Aufnahme des Plans ist vorhanden.</translation>
    </message>
    <message>
        <source>The pattern is shifted by {:.0f} µm, {} {:.0f} µm (against {} of {} in {})</source>
        <translation>Das Muster ist um {:.0f} µm verschoben, {} {:.0f} µm (gegen {} von {} in {})</translation>
    </message>
    <message>
        <source>The pitch error of the screw repeats with every turn and changes as the screw warms.</source>
        <translation>Die Steigungsabweichung des Kugelgewindetriebs wiederholt sich mit jeder Umdrehung und ändert sich mit seiner Erwärmung.</translation>
    </message>
    <message>
        <source>The place along the scan must be finite (mm).</source>
        <translation>Die Stelle entlang des Scans muss endlich sein (mm).</translation>
    </message>
    <message>
        <source>The place of the reference hole</source>
        <translation>Die Lage des Referenzlochs</translation>
    </message>
    <message>
        <source>The plan has no {} left to take; it is kept aside.</source>
        <translation>Der Plan hat nichts Offenes mehr für {}; die Datei wird beiseitegelegt.</translation>
    </message>
    <message>
        <source>Plan completed: {} of {} complete.</source>
        <translation>Plan abgeschlossen: {} von {} vollständig.</translation>
    </message>
    <message>
        <source>The plan of the loop: {}</source>
        <translation>Der Plan des Regelkreises: {}</translation>
    </message>
    <message>
        <source>The plant store&apos;s address has sslmode={}, which does not check who the server is; allowed over the network: sslmode=verify-full with sslrootcert=FILE.</source>
        <translation>Die Adresse der Werksdatenbank hat sslmode={}, das nicht prüft, wer der Server ist; über das Netz zulässig: sslmode=verify-full mit sslrootcert=FILE.</translation>
    </message>
    <message>
        <source>The plant store&apos;s address holds &quot;{}&quot;; allowed: KEY=VALUE pairs as in host=NAME dbname=plant user=NAME.</source>
        <translation>Die Adresse der Werksdatenbank enthält „{}“; zulässig: Paare KEY=VALUE wie in host=NAME dbname=plant user=NAME.</translation>
    </message>
    <message>
        <source>The plant store&apos;s address holds a password, which all who see the address would see; allowed: the password in the file that PGPASSFILE names (mode 0600).</source>
        <translation>Die Adresse der Werksdatenbank enthält ein Passwort, das alle sähen, die die Adresse sehen; zulässig: das Passwort in der Datei, die PGPASSFILE nennt (Modus 0600).</translation>
    </message>
    <message>
        <source>The plant store&apos;s address is a URL, in which a password may stand; allowed: postgresql:host=NAME dbname=plant user=NAME.</source>
        <translation>Die Adresse der Werksdatenbank ist eine URL, in der ein Passwort stehen kann; zulässig: postgresql:host=NAME dbname=plant user=NAME.</translation>
    </message>
    <message>
        <source>The pocket in the scan has a radius of {:.3f} mm, the circle given has {:.3f} mm.</source>
        <translation>Die Tasche im Scan hat einen Radius von {:.3f} mm, der angegebene Kreis {:.3f} mm.</translation>
    </message>
    <message>
        <source>The points of the reference lie too far apart: cells of {:.3g} mm hold too few.</source>
        <translation>Die Punkte der Referenz liegen zu weit auseinander: Zellen von {:.3g} mm enthalten zu wenige.</translation>
    </message>
    <message>
        <source>The position of H{}</source>
        <translation>Die Position von H{}</translation>
    </message>
    <message>
        <source>The profiler is not calibrated ({}): it is taken as parallel to the machine within {} rad and at the tool&apos;s place within 10 mm; the uncertainties carry that.</source>
        <translation>Der Profilsensor ist nicht kalibriert ({}): er gilt als innerhalb von {} rad parallel zur Maschine und innerhalb von 10 mm am Ort des Werkzeugs; die Unsicherheiten enthalten das.</translation>
    </message>
    <message>
        <source>The program is not run: it was not confirmed ({}).</source>
        <translation>Das Programm wird nicht ausgeführt: es wurde nicht bestätigt ({}).</translation>
    </message>
    <message>
        <source>The program is not run: line {}: {}.</source>
        <translation>Das Programm wird nicht ausgeführt: Zeile {}: {}.</translation>
    </message>
    <message>
        <source>The program is not started: the machine stands {:.3f} mm from where it was foreseen to start.</source>
        <translation>Das Programm wird nicht gestartet: die Maschine steht {:.3f} mm von der vorgesehenen Startposition entfernt.</translation>
    </message>
    <message>
        <source>The program is not started: {}</source>
        <translation>Das Programm wird nicht gestartet: {}</translation>
    </message>
    <message>
        <source>The radius of the pocket is {} mm; allowed: positive.</source>
        <translation>Der Radius der Tasche ist {} mm; zulässig: positiv.</translation>
    </message>
    <message>
        <source>The radius of {}</source>
        <translation>Der Radius von {}</translation>
    </message>
    <message>
        <source>The range of the search must not be negative.</source>
        <translation>Der Suchbereich darf nicht negativ sein.</translation>
    </message>
    <message>
        <source>The range of training of input {} is not finite.</source>
        <translation>Der Trainingsbereich des Eingangs {} ist nicht endlich.</translation>
    </message>
    <message>
        <source>The rates of outliers and lost points must lie between 0 and 1.</source>
        <translation>Die Raten von Ausreißern und verlorenen Punkten müssen zwischen 0 und 1 liegen.</translation>
    </message>
    <message>
        <source>The ratio that makes a direction weak must be more than 1.</source>
        <translation>Das Verhältnis, ab dem eine Richtung schwach ist, muss größer als 1 sein.</translation>
    </message>
    <message>
        <source>The recording broke off: {}</source>
        <translation>Die Aufzeichnung brach ab: {}</translation>
    </message>
    <message>
        <source>The reference hole is &quot;{}&quot;; allowed: H1 to H{}.</source>
        <translation>Das Referenzloch ist „{}“; zulässig: H1 bis H{}.</translation>
    </message>
    <message>
        <source>The registration did not settle within {} iterations.</source>
        <translation>Die Registrierung konvergierte nicht innerhalb von {} Iterationen.</translation>
    </message>
    <message>
        <source>The registration needs at least one iteration.</source>
        <translation>Die Registrierung braucht mindestens eine Iteration.</translation>
    </message>
    <message>
        <source>The report is written.</source>
        <translation>Der Bericht ist geschrieben.</translation>
    </message>
    <message>
        <source>The rim of the pocket is seen in only {} places; at least 20 are needed.</source>
        <translation>Der Rand der Tasche ist nur an {} Stellen zu sehen; mindestens 20 sind nötig.</translation>
    </message>
    <message>
        <source>The rotary table warms and grows away from its centre.</source>
        <translation>Der Drehtisch erwärmt sich und wächst von seinem Zentrum weg.</translation>
    </message>
    <message>
        <source>The rotary table warms unevenly and rotates about its centre.</source>
        <translation>Der Drehtisch erwärmt sich ungleichmäßig und verdreht sich um sein Zentrum.</translation>
    </message>
    <message>
        <source>The scan and the reference have no common region.</source>
        <translation>Scan und Referenz haben keinen gemeinsamen Bereich.</translation>
    </message>
    <message>
        <source>The scan covers only {:.0f} % of the reference; at least {:.0f} % are needed.</source>
        <translation>Der Scan deckt nur {:.0f} % der Referenz ab; mindestens {:.0f} % sind nötig.</translation>
    </message>
    <message>
        <source>The scan does not show the same surface as the reference: after the best fit the heights differ by {:.0f} µm ({:.0f} % of the cells agree); another artefact, something over it, or it has moved by more than {:.1f} mm.</source>
        <translation>Der Scan zeigt nicht dieselbe Fläche wie die Referenz: nach der besten Anpassung unterscheiden sich die Höhen um {:.0f} µm ({:.0f} % der Zellen stimmen überein); ein anderer Prüfkörper, etwas darauf, oder er hat sich um mehr als {:.1f} mm bewegt.</translation>
    </message>
    <message>
        <source>The scan is nearly flat: its heights vary by {:.3g} mm about a plane, those of the reference by {:.3g} mm; another surface, or none.</source>
        <translation>Der Scan ist fast eben: seine Höhen schwanken um {:.3g} mm um eine Ebene, die der Referenz um {:.3g} mm; eine andere Fläche oder keine.</translation>
    </message>
    <message>
        <source>The scan is {}: it matches the reference only after this transformation is undone.</source>
        <translation>Der Scan ist {}: er passt erst zur Referenz, wenn diese Transformation rückgängig gemacht ist.</translation>
    </message>
    <message>
        <source>The scan shows no pocket: there is only one level, not a plate and a floor.</source>
        <translation>Der Scan zeigt keine Tasche: es gibt nur eine Ebene, nicht Platte und Boden.</translation>
    </message>
    <message>
        <source>The sensor {} is taken for {} by its name, though its place &quot;{}&quot; says {}; a &quot;role&quot; in machine.json would decide.</source>
        <translation>Der Sensor {} gilt nach seinem Namen als {}, obwohl sein Ort „{}“ {} besagt; eine &quot;role&quot; in machine.json würde entscheiden.</translation>
    </message>
    <message>
        <source>The sensor {} never moves; it is left out as dead.</source>
        <translation>Der Sensor {} ändert sich nie; er wird als ausgefallen ausgelassen.</translation>
    </message>
    <message>
        <source>The servo cycle stands still.</source>
        <translation>Der Servozyklus steht still.</translation>
    </message>
    <message>
        <source>The session was not closed the last time; it is as it was left: {} and {} are there.</source>
        <translation>Die Sitzung wurde zuletzt nicht geschlossen; sie ist unverändert: {} und {} sind vorhanden.</translation>
    </message>
    <message>
        <source>The simulation has {:.0f} ± {:.0f} % too {} of {}: no more than a rough simulation may be off by ({:.0f} %), so it is taken as its error and not as a missing effect.</source>
        <translation>Die Simulation hat {:.0f} ± {:.0f} % zu {} von {}: nicht mehr, als eine grobe Simulation abweichen darf ({:.0f} %); dies gilt als ihr Fehler und nicht als fehlender Effekt.</translation>
    </message>
    <message>
        <source>The simulation is a table ({}) and knows only the measured points. Grid and tables hold the effects added alone: use them where the control already compensates what was simulated.</source>
        <translation>Die Simulation ist eine Tabelle ({}) und kennt nur die gemessenen Punkte. Gitter und Tabellen enthalten allein die hinzugefügten Effekte: dort verwenden, wo die Steuerung das Simulierte schon kompensiert.</translation>
    </message>
    <message>
        <source>The simulation is extrapolated at {} {}, up to {:.3g} mm outside the places that {} predicts.</source>
        <translation>Die Simulation wird an {} {} extrapoliert, bis {:.3g} mm außerhalb der Stellen, die {} vorhersagt.</translation>
    </message>
    <message>
        <source>The simulator failed while it was fitted: {}</source>
        <translation>Der Simulator scheiterte während der Anpassung: {}</translation>
    </message>
    <message>
        <source>The spacings of the virtual profiler must be positive (mm).</source>
        <translation>Die Punktabstände des virtuellen Profilsensors müssen positiv sein (mm).</translation>
    </message>
    <message>
        <source>The speed factor is {:g}; allowed: 1 to 200.</source>
        <translation>Der Zeitfaktor ist {:g}; zulässig: 1 bis 200.</translation>
    </message>
    <message>
        <source>The speed factor of the machine is {:g}; allowed: above 0, up to 1000.</source>
        <translation>Der Zeitfaktor der Maschine ist {:g}; zulässig: über 0, bis 1000.</translation>
    </message>
    <message>
        <source>The spindle is still turning ({:.0f} rpm): wait until it stands still.</source>
        <translation>Die Spindel dreht noch ({:.0f} rpm): warten, bis sie steht.</translation>
    </message>
    <message>
        <source>The spindle shaft and housing grow along Z as the bearings heat them; the heat follows the speed and reaches the structure with one or two first-order time constants.</source>
        <translation>Spindelwelle und Gehäuse wachsen entlang Z, wenn die Lager sie erwärmen; die Wärme folgt der Drehzahl und erreicht die Struktur mit einer oder zwei Zeitkonstanten erster Ordnung.</translation>
    </message>
    <message>
        <source>The spindle support warms unevenly and shifts the nose sideways, the same everywhere in the working space, following the spindle heat with one or two first-order time constants.</source>
        <translation>Die Spindelaufnahme erwärmt sich ungleichmäßig und verschiebt die Spindelnase seitlich, im ganzen Arbeitsraum gleich; sie folgt der Spindelwärme mit einer oder zwei Zeitkonstanten erster Ordnung.</translation>
    </message>
    <message>
        <source>The start must be finite.</source>
        <translation>Der Startwert muss endlich sein.</translation>
    </message>
    <message>
        <source>The steepest slope of the virtual profiler must be positive.</source>
        <translation>Die größte Steigung des virtuellen Profilsensors muss positiv sein.</translation>
    </message>
    <message>
        <source>The structure follows the temperature of the room and shifts the tool, the same at every position.</source>
        <translation>Die Struktur folgt der Raumtemperatur und verschiebt das Werkzeug, an jeder Position gleich.</translation>
    </message>
    <message>
        <source>The study needs non-negative uncertainties and at least one trial.</source>
        <translation>Die Studie braucht nicht negative Unsicherheiten und mindestens einen Versuch.</translation>
    </message>
    <message>
        <source>The surface determines all six errors.</source>
        <translation>Die Fläche bestimmt alle sechs Abweichungen.</translation>
    </message>
    <message>
        <source>The surface does not determine{}.</source>
        <translation>Die Fläche bestimmt nicht{}.</translation>
    </message>
    <message>
        <source>The surface leaves {} free: {}.</source>
        <translation>Die Fläche lässt {} frei: {}.</translation>
    </message>
    <message>
        <source>The table {} has no value at {:.6g} s: a power of a negative number, or of zero; allowed: powers that every value of {} has.</source>
        <translation>Die Tabelle {} hat bei {:.6g} s keinen Wert: eine Potenz einer negativen Zahl oder von null; zulässig: Potenzen, die jeder Wert von {} hat.</translation>
    </message>
    <message>
        <source>The tables differ in size, so there is no difference of heat maps; the common points are compared.</source>
        <translation>Die Tische sind verschieden groß, daher gibt es keine Differenz der Farbkarten; verglichen werden die gemeinsamen Punkte.</translation>
    </message>
    <message>
        <source>The temperature of the artefact</source>
        <translation>Die Temperatur des Prüfkörpers</translation>
    </message>
    <message>
        <source>The threshold for outliers must be positive.</source>
        <translation>Die Schwelle für Ausreißer muss positiv sein.</translation>
    </message>
    <message>
        <source>The two clouds do not determine a motion between them.</source>
        <translation>Die beiden Punktwolken bestimmen keine Bewegung zwischen ihnen.</translation>
    </message>
    <message>
        <source>The two have neither a point nor a heat map in common.</source>
        <translation>Die beiden haben weder einen Punkt noch eine Farbkarte gemeinsam.</translation>
    </message>
    <message>
        <source>The uncertainties of the pocket must be positive (mm).</source>
        <translation>Die Unsicherheiten der Tasche müssen positiv sein (mm).</translation>
    </message>
    <message>
        <source>The uncertainty of the certificate</source>
        <translation>Die Unsicherheit des Kalibrierscheins</translation>
    </message>
    <message>
        <source>The uncertainty of the mounting must be positive (rad).</source>
        <translation>Die Unsicherheit des Anbaus muss positiv sein (rad).</translation>
    </message>
    <message>
        <source>The virtual machine does not run with {}: {}.</source>
        <translation>Die virtuelle Maschine läuft nicht mit {}: {}.</translation>
    </message>
    <message>
        <source>The virtual profiler needs at least 2 points per profile.</source>
        <translation>Der virtuelle Profilsensor braucht mindestens 2 Punkte je Profil.</translation>
    </message>
    <message>
        <source>The virtual scan {} sees no surface.</source>
        <translation>Der virtuelle Scan {} sieht keine Fläche.</translation>
    </message>
    <message>
        <source>The watchdog of {} does not hear us.</source>
        <translation>Die Überwachung (Watchdog) von {} hört uns nicht.</translation>
    </message>
    <message>
        <source>The width of a cell must not be negative (mm).</source>
        <translation>Die Breite einer Zelle darf nicht negativ sein (mm).</translation>
    </message>
    <message>
        <source>There are no captures to evaluate yet.</source>
        <translation>Es gibt noch keine Aufnahmen auszuwerten.</translation>
    </message>
    <message>
        <source>There is no operating log: effects that follow speed, feed or temperature cannot be tried.</source>
        <translation>Es gibt kein Betriebsprotokoll: Effekte, die Drehzahl, Vorschub oder Temperatur folgen, können nicht geprüft werden.</translation>
    </message>
    <message>
        <source>There is no plan that says what it is; make one, it is kept meanwhile.</source>
        <translation>Kein Plan sagt, was es ist; einen erstellen, die Datei wird inzwischen aufgehoben.</translation>
    </message>
    <message>
        <source>There is no plan yet.</source>
        <translation>Es gibt noch keinen Plan.</translation>
    </message>
    <message>
        <source>There is no such model.</source>
        <translation>Es gibt kein solches Modell.</translation>
    </message>
    <message>
        <source>There is not enough memory to read it.</source>
        <translation>Der Speicher reicht zum Lesen nicht aus.</translation>
    </message>
    <message>
        <source>There is nothing to compare yet.</source>
        <translation>Es gibt noch nichts zu vergleichen.</translation>
    </message>
    <message>
        <source>There is nothing to report yet.</source>
        <translation>Es gibt noch nichts zu berichten.</translation>
    </message>
    <message>
        <source>This campaign comes without a simulation to compare with.</source>
        <translation>Zu dieser Kampagne gehört keine Simulation zum Vergleich.</translation>
    </message>
    <message>
        <source>Touch {} again, touch{} {}: {}.</source>
        <translation>{} erneut antasten, Antastung{} {}: {}.</translation>
    </message>
    <message>
        <source>Tukey&apos;s threshold must be above 2 standard deviations.</source>
        <translation>Die Tukey-Schwelle muss über 2 Standardabweichungen liegen.</translation>
    </message>
    <message>
        <source>Uneven warming of bed and column turns the machine frame as one body; the deviation grows in proportion to the distance from the axis of the turn.</source>
        <translation>Ungleichmäßige Erwärmung von Bett und Ständer dreht das Maschinengestell als einen Körper; die Abweichung wächst proportional zum Abstand von der Drehachse.</translation>
    </message>
    <message>
        <source>The result is not good enough.</source>
        <translation>Das Ergebnis ist nicht gut genug.</translation>
    </message>
    <message>
        <source>What {} does is not known: {}</source>
        <translation>Die Wirkung von {} ist nicht bekannt: {}</translation>
    </message>
    <message>
        <source>Where sensors sit was read from their names, please confirm: {}. A &quot;role&quot; in machine.json decides.</source>
        <translation>Der Ort der Sensoren wurde aus ihren Namen geschlossen, bitte bestätigen: {}. Eine &quot;role&quot; in machine.json entscheidet.</translation>
    </message>
    <message>
        <source>Calculate the compensation.</source>
        <translation>Kompensation berechnen.</translation>
    </message>
    <message>
        <source>Write the report.</source>
        <translation>Den Bericht schreiben.</translation>
    </message>
    <message>
        <source>X and Y</source>
        <translation>X und Y</translation>
    </message>
    <message>
        <source>X at rest</source>
        <translation>X im Stillstand</translation>
    </message>
    <message>
        <source>X moving</source>
        <translation>X bewegt sich</translation>
    </message>
    <message>
        <source>Y at rest</source>
        <translation>Y im Stillstand</translation>
    </message>
    <message>
        <source>Y moving</source>
        <translation>Y bewegt sich</translation>
    </message>
    <message>
        <source>You stated that the instrument was warm.</source>
        <translation>Erklärt wurde: das Messgerät war warm.</translation>
    </message>
    <message>
        <source>Z at rest</source>
        <translation>Z im Stillstand</translation>
    </message>
    <message>
        <source>Z moving</source>
        <translation>Z bewegt sich</translation>
    </message>
    <message>
        <source>[time in s, speed in rpm]</source>
        <translation>[Zeit in s, Drehzahl in rpm]</translation>
    </message>
    <message>
        <source>[x, y, width, height] in pixels, width and height greater than zero</source>
        <translation>[x, y, Breite, Höhe] in Pixeln, Breite und Höhe größer als null</translation>
    </message>
    <message>
        <source>[x, y, z] in mm</source>
        <translation>[x, y, z] in mm</translation>
    </message>
    <message>
        <source>&quot;discrepancy_s&quot; without a simulation.</source>
        <translation>&quot;discrepancy_s&quot; ohne Simulation.</translation>
    </message>
    <message>
        <source>&quot;lag&quot; with at least one driver, or &quot;none&quot;, &quot;step&quot;, &quot;pulse&quot; without</source>
        <translation>&quot;lag&quot; mit mindestens einer Antriebsgröße oder &quot;none&quot;, &quot;step&quot;, &quot;pulse&quot; ohne</translation>
    </message>
    <message>
        <source>&quot;named&quot;, &quot;ask&quot; or a list of ids of effects</source>
        <translation>&quot;named&quot;, &quot;ask&quot; oder eine Liste von Kennungen von Effekten</translation>
    </message>
    <message>
        <source>&quot;seeds&quot;:[FIRST,LAST] and no &quot;campaigns&quot; with this work</source>
        <translation>&quot;seeds&quot;:[ERSTER,LETZTER] und kein &quot;campaigns&quot; bei dieser Arbeit</translation>
    </message>
    <message>
        <source>&quot;touch_sigma_um&quot; is not above zero.</source>
        <translation>&quot;touch_sigma_um&quot; ist nicht über null.</translation>
    </message>
    <message>
        <source>&quot;{{&quot; is not closed on its line; allowed: {{name}}, {{expression}} or {{table:NAME}}.</source>
        <translation>„{{“ ist auf seiner Zeile nicht geschlossen; zulässig: {{name}}, {{expression}} oder {{table:NAME}}.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; cannot be foreseen; allowed: plain words such as G1 X10 F100</source>
        <translation>„{}“ ist nicht vorhersehbar; zulässig: einfache Wörter wie G1 X10 F100</translation>
    </message>
    <message>
        <source>&quot;{}&quot; cannot be read</source>
        <translation>„{}“ ist nicht lesbar</translation>
    </message>
    <message>
        <source>&quot;{}&quot; has no value at {} s, where {} is {:g}; allowed: powers that every value of the column has.</source>
        <translation>„{}“ hat keinen Wert bei {} s, wo {} = {:g} ist; zulässig: Potenzen, die jeder Wert der Spalte hat.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not an address that can be listed; allowed: one that begins with {}.</source>
        <translation>„{}“ ist keine Adresse, deren Angebot sich auflisten lässt; zulässig: eine, die mit {} beginnt.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not an axis</source>
        <translation>„{}“ ist keine Achse</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a data item of LinuxCNC; allowed: {}.</source>
        <translation>„{}“ ist kein Datenpunkt von LinuxCNC; zulässig: {}.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a kind of event; allowed: {}.</source>
        <translation>„{}“ ist keine Art von Ereignis; zulässig: {}.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a metric; allowed: spBv1.0/group/node[/device]#metric.</source>
        <translation>„{}“ ist keine Metrik; zulässig: spBv1.0/Gruppe/Knoten[/Gerät]#Metrik.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a number; allowed: a number such as -12.345.</source>
        <translation>„{}“ ist keine Zahl; zulässig: eine Zahl wie -12.345.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a parameter of {}; allowed: {}.</source>
        <translation>„{}“ ist kein Parameter von {}; zulässig: {}.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a register; allowed: {}.</source>
        <translation>„{}“ ist kein Register; zulässig: {}.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a time; allowed: UTC such as 2026-01-31T08:00:00Z.</source>
        <translation>„{}“ ist keine Zeit; zulässig: UTC wie 2026-01-31T08:00:00Z.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a topic; allowed: one topic without wildcards.</source>
        <translation>„{}“ ist kein Topic; zulässig: ein Topic ohne Platzhalter.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a number; allowed: a finite number with a decimal point.</source>
        <translation>„{}“ ist keine Zahl; zulässig: eine endliche Zahl mit Dezimalpunkt.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a number; allowed: a finite number with a decimal point{}.</source>
        <translation>„{}“ ist keine Zahl; zulässig: eine endliche Zahl mit Dezimalpunkt{}.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; needs a log.csv, which the campaign does not have; allowed: effects without drivers.</source>
        <translation>„{}“ braucht eine log.csv, die der Kampagne fehlt; zulässig: Effekte ohne Antriebsgrößen.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; stands on the tool side</source>
        <translation>„{}“ steht auf der Werkzeugseite</translation>
    </message>
    <message>
        <source>&quot;{}&quot; {}, run with {}; log and input are kept in {}.</source>
        <translation>„{}“ {}, ausgeführt mit {}; Protokoll und Eingabe liegen in {}.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; {}; allowed: a file inside the folder, given relative to it.</source>
        <translation>„{}“ {}; zulässig: eine Datei im Ordner, relativ zu ihm angegeben.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; {}; allowed: {}, each with a power such as &quot;^1.5&quot; if need be.</source>
        <translation>„{}“ {}; zulässig: {}, jede bei Bedarf mit einer Potenz wie &quot;^1.5&quot;.</translation>
    </message>
    <message>
        <source>
failed for good: {}</source>
        <translation>
endgültig fehlgeschlagen: {}</translation>
    </message>
    <message>
        <source>a .dat (or .frd) of CalculiX</source>
        <translation>eine .dat (oder .frd) von CalculiX</translation>
    </message>
    <message>
        <source>a CSV cloud is text; allowed: ascii.</source>
        <translation>eine CSV-Punktwolke ist Text; zulässig: ascii.</translation>
    </message>
    <message>
        <source>a UTC time such as &quot;2026-01-31T08:00:00Z&quot;</source>
        <translation>eine UTC-Zeit wie &quot;2026-01-31T08:00:00Z&quot;</translation>
    </message>
    <message>
        <source>a ball screw</source>
        <translation>ein Kugelgewindetrieb</translation>
    </message>
    <message>
        <source>a beam whose ends from_mm and to_mm differ</source>
        <translation>ein Balken, dessen Enden from_mm und to_mm verschieden sind</translation>
    </message>
    <message>
        <source>a chain such as &quot;V [w-X&apos;-Y&apos;-b-Z-(C)-t]&quot;: from w over b to t, axes X, Y, Z, A, B, C with an optional number, &apos; on those that carry the workpiece, the spindle in brackets</source>
        <translation>eine Kette wie &quot;V [w-X&apos;-Y&apos;-b-Z-(C)-t]&quot;: von w über b nach t, Achsen X, Y, Z, A, B, C mit optionaler Nummer, &apos; an denen, die das Werkstück tragen, die Spindel in Klammern</translation>
    </message>
    <message>
        <source>a circle is invariant under rotation about its axis</source>
        <translation>ein Kreis ist invariant gegen Drehung um seine Achse</translation>
    </message>
    <message>
        <source>a circle of radius {} µm at ({}, {}) µm from an ellipse&apos;s centre touches the ellipse.</source>
        <translation>ein Kreis mit Radius {} µm bei ({}, {}) um vom Zentrum einer Ellipse berührt die Ellipse.</translation>
    </message>
    <message>
        <source>a column has no name; allowed: one name per column.</source>
        <translation>eine Spalte hat keinen Namen; zulässig: ein Name je Spalte.</translation>
    </message>
    <message>
        <source>a column of the campaign&apos;s log.csv, which this campaign does not have</source>
        <translation>eine Spalte von log.csv der Kampagne, die dieser Kampagne fehlt</translation>
    </message>
    <message>
        <source>a column that is not mapped twice</source>
        <translation>eine noch nicht zugeordnete Spalte</translation>
    </message>
    <message>
        <source>a common time history</source>
        <translation>einen gemeinsamen zeitlichen Verlauf</translation>
    </message>
    <message>
        <source>a time history of its own</source>
        <translation>einen eigenen zeitlichen Verlauf</translation>
    </message>
    <message>
        <source>a distance of {:g} mm between positions is not allowed; allowed: 0 or more.</source>
        <translation>ein Abstand von {:g} mm zwischen Positionen ist nicht zulässig; zulässig: 0 oder mehr.</translation>
    </message>
    <message>
        <source>a drift limit of {} µm/h is not allowed; allowed: greater than zero.</source>
        <translation>eine Driftgrenze von {} µm/h ist nicht zulässig; zulässig: größer als null.</translation>
    </message>
    <message>
        <source>a driver that log.csv holds</source>
        <translation>eine Antriebsgröße, die log.csv enthält</translation>
    </message>
    <message>
        <source>a feed move that is not a retract after a touch</source>
        <translation>eine Vorschubbewegung, die kein Rückzug nach einer Antastung ist</translation>
    </message>
    <message>
        <source>a feed move without F</source>
        <translation>eine Vorschubbewegung ohne F</translation>
    </message>
    <message>
        <source>a feed that is not above zero</source>
        <translation>ein Vorschub, der nicht größer als null ist</translation>
    </message>
    <message>
        <source>a file in {}</source>
        <translation>eine Datei in {}</translation>
    </message>
    <message>
        <source>a file that does not stand as {} in the folder of a run beside another one</source>
        <translation>eine Datei, die nicht als {} im Ordner eines Laufs neben einer anderen steht</translation>
    </message>
    <message>
        <source>a file that is there</source>
        <translation>eine vorhandene Datei</translation>
    </message>
    <message>
        <source>a file that nobody but its owner can read (chmod 600)</source>
        <translation>eine Datei, die nur ihr Eigentümer lesen kann (chmod 600)</translation>
    </message>
    <message>
        <source>a finite number</source>
        <translation>eine endliche Zahl</translation>
    </message>
    <message>
        <source>a folder</source>
        <translation>ein Ordner</translation>
    </message>
    <message>
        <source>a gain of</source>
        <translation>eine Verstärkung von</translation>
    </message>
    <message>
        <source>a gap of {:.1f} mm at {} = {:.1f} mm</source>
        <translation>eine Lücke von {:.1f} mm bei {} = {:.1f} mm</translation>
    </message>
    <message>
        <source>a goal of {:g} µm cannot be met; allowed: a positive number.</source>
        <translation>ein Ziel von {:g} µm ist nicht erreichbar; zulässig: eine positive Zahl.</translation>
    </message>
    <message>
        <source>a goal of {:g} µrad cannot be met; allowed: a positive number, or 0 for none.</source>
        <translation>ein Ziel von {:g} µrad ist nicht erreichbar; zulässig: eine positive Zahl oder 0 für keines.</translation>
    </message>
    <message>
        <source>a grid of {} x {} nodes is not possible; allowed: 2 to 2000 a side.</source>
        <translation>ein Gitter von {} x {} Knoten ist nicht möglich; zulässig: 2 bis 2000 je Seite.</translation>
    </message>
    <message>
        <source>a high-pass over {} cycles is not allowed; allowed: an odd number from 3.</source>
        <translation>ein Hochpass über {} Zyklen ist nicht zulässig; zulässig: eine ungerade Zahl ab 3.</translation>
    </message>
    <message>
        <source>a time constant has no effect on the output; use fewer time constants or inputs.</source>
        <translation>eine Zeitkonstante hat keine Wirkung auf den Ausgang; weniger Zeitkonstanten oder Eingänge verwenden.</translation>
    </message>
    <message>
        <source>a time constant together with its driver</source>
        <translation>eine Zeitkonstante zusammen mit ihrer Antriebsgröße</translation>
    </message>
    <message>
        <source>a lattice needs 2 to 100 positions a side.</source>
        <translation>ein Raster braucht 2 bis 100 Positionen je Seite.</translation>
    </message>
    <message>
        <source>a letter and then letters, digits, _ and ., not beginning with &quot;sensor.&quot; or &quot;simulation.&quot;</source>
        <translation>ein Buchstabe, dann Buchstaben, Ziffern, _ und ., nicht beginnend mit &quot;sensor.&quot; oder &quot;simulation.&quot;</translation>
    </message>
    <message>
        <source>a list</source>
        <translation>eine Liste</translation>
    </message>
    <message>
        <source>a list &quot;campaigns&quot; and no &quot;seeds&quot; with this work</source>
        <translation>eine Liste &quot;campaigns&quot; und kein &quot;seeds&quot; bei dieser Arbeit</translation>
    </message>
    <message>
        <source>a list is not a property of a point; allowed: numbers.</source>
        <translation>eine Liste ist keine Eigenschaft eines Punkts; zulässig: Zahlen.</translation>
    </message>
    <message>
        <source>a list of at least one point</source>
        <translation>eine Liste mit mindestens einem Punkt</translation>
    </message>
    <message>
        <source>a list of texts, the program first</source>
        <translation>eine Liste von Texten, das Programm zuerst</translation>
    </message>
    <message>
        <source>a list of three numbers</source>
        <translation>eine Liste aus drei Zahlen</translation>
    </message>
    <message>
        <source>a list of two numbers, x and y in µm</source>
        <translation>eine Liste aus zwei Zahlen, x und y in µm</translation>
    </message>
    <message>
        <source>a list of two whole numbers, first and last</source>
        <translation>eine Liste aus zwei ganzen Zahlen, erste und letzte</translation>
    </message>
    <message>
        <source>a list with at least one axis</source>
        <translation>eine Liste mit mindestens einer Achse</translation>
    </message>
    <message>
        <source>a list with one entry for every gain, at least one</source>
        <translation>eine Liste mit einem Eintrag je Verstärkung, mindestens einem</translation>
    </message>
    <message>
        <source>a machine with a profiler</source>
        <translation>eine Maschine mit Profilsensor</translation>
    </message>
    <message>
        <source>a machine with fiducials</source>
        <translation>eine Maschine mit Messmarken</translation>
    </message>
    <message>
        <source>a machine with points</source>
        <translation>eine Maschine mit Punkten</translation>
    </message>
    <message>
        <source>a machine with styli</source>
        <translation>eine Maschine mit Tastereinsätzen</translation>
    </message>
    <message>
        <source>a margin of {} mm leaves nothing of the table.</source>
        <translation>ein Rand von {} mm lässt nichts vom Tisch übrig.</translation>
    </message>
    <message>
        <source>a measuring cycle gave {} of {} touches and is not used{}</source>
        <translation>ein Messzyklus gab {} von {} Antastungen und wird nicht verwendet{}</translation>
    </message>
    <message>
        <source>A model of higher order is not supported. {}</source>
        <translation>Ein Modell höherer Ordnung wird nicht gestützt. {}</translation>
    </message>
    <message>
        <source>a move before G0, G1 or G38</source>
        <translation>eine Bewegung vor G0, G1 oder G38</translation>
    </message>
    <message>
        <source>a move stands before G90 and G21</source>
        <translation>eine Bewegung steht vor G90 und G21</translation>
    </message>
    <message>
        <source>a move without G0 or G1</source>
        <translation>eine Bewegung ohne G0 oder G1</translation>
    </message>
    <message>
        <source>a move without M91 is not in machine coordinates</source>
        <translation>eine Bewegung ohne M91 ist nicht in Maschinenkoordinaten</translation>
    </message>
    <message>
        <source>a move without SUPA is not in machine coordinates</source>
        <translation>eine Bewegung ohne SUPA ist nicht in Maschinenkoordinaten</translation>
    </message>
    <message>
        <source>a name of a column without commas and quotes, other than time_s</source>
        <translation>ein Spaltenname ohne Kommas und Anführungszeichen, anders als time_s</translation>
    </message>
    <message>
        <source>a name such as T_column_degC</source>
        <translation>ein Name wie T_column_degC</translation>
    </message>
    <message>
        <source>a name that no other sensor has</source>
        <translation>ein Name, den kein anderer Sensor hat</translation>
    </message>
    <message>
        <source>a name that no other source has</source>
        <translation>ein Name, den keine andere Quelle hat</translation>
    </message>
    <message>
        <source>a name that was not used before in this list</source>
        <translation>ein in dieser Liste noch nicht verwendeter Name</translation>
    </message>
    <message>
        <source>a name with an ending, which the filled file does not have</source>
        <translation>ein Name mit einer Endung, die der ausgefüllten Datei fehlt</translation>
    </message>
    <message>
        <source>a number</source>
        <translation>eine Zahl</translation>
    </message>
    <message>
        <source>a number from 0 to below 1</source>
        <translation>eine Zahl von 0 bis unter 1</translation>
    </message>
    <message>
        <source>a number from &quot;min&quot; {} to &quot;max&quot; {} of {}</source>
        <translation>eine Zahl von &quot;min&quot; {} bis &quot;max&quot; {} von {}</translation>
    </message>
    <message>
        <source>a number from {} to {}</source>
        <translation>eine Zahl von {} bis {}</translation>
    </message>
    <message>
        <source>a number greater than zero</source>
        <translation>eine Zahl größer als null</translation>
    </message>
    <message>
        <source>a number in</source>
        <translation>eine Zahl in</translation>
    </message>
    <message>
        <source>a number of an effect of {}, or one whose size is a parameter as well</source>
        <translation>eine Zahl eines Effekts von {} oder eines, dessen Größe ebenfalls ein Parameter ist</translation>
    </message>
    <message>
        <source>a number other than zero</source>
        <translation>eine Zahl ungleich null</translation>
    </message>
    <message>
        <source>a number that is not negative</source>
        <translation>eine nicht negative Zahl</translation>
    </message>
    <message>
        <source>a number up to &quot;max&quot;, which is {}</source>
        <translation>eine Zahl bis &quot;max&quot;, das ist {}</translation>
    </message>
    <message>
        <source>a path within the folder of the simulator, relative to it and without &quot;..&quot;</source>
        <translation>ein Pfad im Ordner des Simulators, relativ dazu und ohne &quot;..&quot;</translation>
    </message>
    <message>
        <source>a pattern in which every { has its }</source>
        <translation>ein Muster, in dem jede { ihre } hat</translation>
    </message>
    <message>
        <source>a period that makes at most {:.0f} rows of the duration</source>
        <translation>eine Periode, die höchstens {:.0f} Zeilen der Dauer ergibt</translation>
    </message>
    <message>
        <source>a pipe</source>
        <translation>eine Pipe</translation>
    </message>
    <message>
        <source>a pitch of {} µm is not allowed; 20 ... 100000 µm are.</source>
        <translation>ein Raster von {} µm ist nicht zulässig; zulässig: 20 ... 100000 µm.</translation>
    </message>
    <message>
        <source>a printed model needs at least one a, two b with b0 not zero, and a positive period.</source>
        <translation>ein gedrucktes Modell braucht mindestens ein a, zwei b mit b0 ungleich null und eine positive Periode.</translation>
    </message>
    <message>
        <source>a process</source>
        <translation>ein Prozess</translation>
    </message>
    <message>
        <source>a program and its arguments</source>
        <translation>ein Programm und seine Argumente</translation>
    </message>
    <message>
        <source>a program that is not the loop&apos;s is running: the loop waits for its end</source>
        <translation>ein fremdes Programm läuft: der Regelkreis wartet auf sein Ende</translation>
    </message>
    <message>
        <source>a quoted field is not closed; allowed: a second double quote.</source>
        <translation>ein Feld in Anführungszeichen ist nicht geschlossen; zulässig: ein zweites Anführungszeichen.</translation>
    </message>
    <message>
        <source>a radius above 0 mm after brush</source>
        <translation>ein Radius über 0 mm nach brush</translation>
    </message>
    <message>
        <source>a rapid move goes down beside the artefact; allowed: guarded moves</source>
        <translation>eine Eilgangbewegung fährt neben dem Prüfkörper abwärts; zulässig: überwachte Bewegungen</translation>
    </message>
    <message>
        <source>a rapid move sideways is not above the artefact</source>
        <translation>eine seitliche Eilgangbewegung liegt nicht über dem Prüfkörper</translation>
    </message>
    <message>
        <source>A richer model fits better. {}</source>
        <translation>Ein reichhaltigeres Modell passt besser. {}</translation>
    </message>
    <message>
        <source>a scale</source>
        <translation>ein Maßstab</translation>
    </message>
    <message>
        <source>a secret stands in the file; allowed: &quot;password_env&quot; (a variable of the environment) or &quot;password_file&quot; (a file that only its owner can read).</source>
        <translation>in der Datei steht ein Geheimnis; zulässig: &quot;password_env&quot; (eine Umgebungsvariable) oder &quot;password_file&quot; (eine Datei, die nur ihr Eigentümer lesen kann).</translation>
    </message>
    <message>
        <source>a signal has missing values inside the range; resample it with gaps bridged, or cut the range at the gap.</source>
        <translation>einem Signal fehlen Werte im Bereich; mit überbrückten Lücken neu abtasten oder den Bereich an der Lücke teilen.</translation>
    </message>
    <message>
        <source>a simulation table needs a measurement to predict; give a measurement.</source>
        <translation>eine Simulationstabelle braucht eine Messung zum Vorhersagen; eine Messung angeben.</translation>
    </message>
    <message>
        <source>a square matrix of two rows for every input</source>
        <translation>eine quadratische Matrix mit zwei Zeilen je Eingang</translation>
    </message>
    <message>
        <source>a state of &quot;states&quot;</source>
        <translation>ein Zustand aus &quot;states&quot;</translation>
    </message>
    <message>
        <source>a stylus of radius {} mm does not fit into a hole of diameter {} mm</source>
        <translation>ein Tastereinsatz mit Radius {} mm passt nicht in ein Loch von {} mm Durchmesser</translation>
    </message>
    <message>
        <source>a surface with the x_mm and z_mm of the first one: the artefacts stand along Y</source>
        <translation>eine Fläche mit x_mm und z_mm der ersten: die Prüfkörper stehen entlang Y</translation>
    </message>
    <message>
        <source>a table of predictions</source>
        <translation>eine Tabelle von Vorhersagen</translation>
    </message>
    <message>
        <source>a temperature pattern that the model of {} has not seen</source>
        <translation>ein Temperaturmuster, das das Modell von {} nicht kennt</translation>
    </message>
    <message>
        <source>a text</source>
        <translation>ein Text</translation>
    </message>
    <message>
        <source>a text that is not empty</source>
        <translation>ein nicht leerer Text</translation>
    </message>
    <message>
        <source>a text without a zero</source>
        <translation>ein Text ohne Nullzeichen</translation>
    </message>
    <message>
        <source>a time after that of the segment before</source>
        <translation>eine Zeit nach der des Abschnitts davor</translation>
    </message>
    <message>
        <source>a time offset of {:g} s for {} cannot be; allowed: -1e6 to 1e6 s.</source>
        <translation>ein Zeitversatz von {:g} s für {} ist nicht möglich; zulässig: -1e6 bis 1e6 s.</translation>
    </message>
    <message>
        <source>a unit from 0 to 247</source>
        <translation>eine Einheit von 0 bis 247</translation>
    </message>
    <message>
        <source>a unit such as CELSIUS, FAHRENHEIT, MILLIMETER, mm/s or rpm</source>
        <translation>eine Einheit wie CELSIUS, FAHRENHEIT, MILLIMETER, mm/s oder rpm</translation>
    </message>
    <message>
        <source>a unit that can become {}, the unit of the column</source>
        <translation>eine Einheit, die sich in {}, die Einheit der Spalte, umrechnen lässt</translation>
    </message>
    <message>
        <source>a value of a parameter of this simulator</source>
        <translation>ein Wert eines Parameters dieses Simulators</translation>
    </message>
    <message>
        <source>a value of a sensor of the tables, such as &quot;sensor.T_room_degC.gain&quot;</source>
        <translation>ein Wert eines Sensors der Tabellen, etwa &quot;sensor.T_room_degC.gain&quot;</translation>
    </message>
    <message>
        <source>a variable that is set in the environment</source>
        <translation>eine gesetzte Umgebungsvariable</translation>
    </message>
    <message>
        <source>a vector of length 1</source>
        <translation>ein Vektor der Länge 1</translation>
    </message>
    <message>
        <source>a version from 1 to {} (a newer file needs a newer program)</source>
        <translation>eine Version von 1 bis {} (eine neuere Datei braucht ein neueres Programm)</translation>
    </message>
    <message>
        <source>a virtual campaign needs a fiducial and a thermal state.</source>
        <translation>eine virtuelle Kampagne braucht eine Messmarke und einen thermischen Zustand.</translation>
    </message>
    <message>
        <source>a whole number</source>
        <translation>eine ganze Zahl</translation>
    </message>
    <message>
        <source>a whole number from 0</source>
        <translation>eine ganze Zahl ab 0</translation>
    </message>
    <message>
        <source>a whole number from 0 to {}</source>
        <translation>eine ganze Zahl von 0 bis {}</translation>
    </message>
    <message>
        <source>a whole number from 0, less than the number of states</source>
        <translation>eine ganze Zahl ab 0, kleiner als die Anzahl der Zustände</translation>
    </message>
    <message>
        <source>a whole number from {:.0f} to {:.0f}</source>
        <translation>eine ganze Zahl von {:.0f} bis {:.0f}</translation>
    </message>
    <message>
        <source>a whole number from {}</source>
        <translation>eine ganze Zahl ab {}</translation>
    </message>
    <message>
        <source>above 0</source>
        <translation>über 0</translation>
    </message>
    <message>
        <source>above 0, up to 1</source>
        <translation>über 0, bis 1</translation>
    </message>
    <message>
        <source>action control limit</source>
        <translation>Eingriffsgrenze</translation>
    </message>
    <message>
        <source>active: {}; inputs {:.0f} s old</source>
        <translation>aktiv: {}; Eingänge {:.0f} s alt</translation>
    </message>
    <message>
        <source>added to the simulation: {}</source>
        <translation>zur Simulation hinzugefügt: {}</translation>
    </message>
    <message>
        <source>After: no column compensation_on in the log: nothing but the operator&apos;s word says that the control was compensating.</source>
        <translation>Nachher: keine Spalte compensation_on im Protokoll: nur das Wort des Bedieners sagt, dass die Steuerung kompensierte.</translation>
    </message>
    <message>
        <source>After: {} of {} {} taken without compensation and left out.</source>
        <translation>Nachher: {} von {} {} ohne Kompensation aufgenommen und ausgelassen.</translation>
    </message>
    <message>
        <source>ahead of</source>
        <translation>vor</translation>
    </message>
    <message>
        <source>all candidate inputs are constant in the training range; allowed: inputs that change.</source>
        <translation>alle Eingangskandidaten sind im Trainingsbereich konstant; zulässig: Eingänge, die sich ändern.</translation>
    </message>
    <message>
        <source>all heights of {} lie on one side of focus: the sharpest image is the {} one; move the range of heights {}.</source>
        <translation>alle Höhen von {} liegen auf einer Seite des Fokus: das schärfste Bild ist das {}; den Höhenbereich verschieben: {}.</translation>
    </message>
    <message>
        <source>all nine parameters are determined</source>
        <translation>alle neun Parameter sind bestimmt</translation>
    </message>
    <message>
        <source>all parameters are determined</source>
        <translation>alle Parameter sind bestimmt</translation>
    </message>
    <message>
        <source>all parameters of all cycles are determined</source>
        <translation>alle Parameter aller Zyklen sind bestimmt</translation>
    </message>
    <message>
        <source>all points</source>
        <translation>alle Punkte</translation>
    </message>
    <message>
        <source>all readings were taken at one position; allowed: two positions near the ends of travel.</source>
        <translation>alle Messwerte wurden an einer Position aufgenommen; zulässig: zwei Positionen nahe den Enden des Verfahrwegs.</translation>
    </message>
    <message>
        <source>all {} values are the same as before: it is the same measurement; allowed: the same plan measured again with the compensation on.</source>
        <translation>alle {} Werte sind dieselben wie zuvor: es ist dieselbe Messung; zulässig: derselbe Plan, mit eingeschalteter Kompensation erneut gemessen.</translation>
    </message>
    <message>
        <source>along ({:.2f}, {:.2f}, {:.2f})</source>
        <translation>entlang ({:.2f}, {:.2f}, {:.2f})</translation>
    </message>
    <message>
        <source>along X</source>
        <translation>entlang X</translation>
    </message>
    <message>
        <source>along Y</source>
        <translation>entlang Y</translation>
    </message>
    <message>
        <source>along the axis</source>
        <translation>entlang der Achse</translation>
    </message>
    <message>
        <source>an address that begins with {}</source>
        <translation>eine Adresse, die mit {} beginnt</translation>
    </message>
    <message>
        <source>an artefact with at least one ball under &quot;balls&quot;</source>
        <translation>ein Prüfkörper mit mindestens einer Kugel unter &quot;balls&quot;</translation>
    </message>
    <message>
        <source>an axis across {}, along which the profiler travels</source>
        <translation>eine Achse quer zu {}, entlang der sich der Profilsensor bewegt</translation>
    </message>
    <message>
        <source>an effect of this scenario</source>
        <translation>ein Effekt dieses Szenarios</translation>
    </message>
    <message>
        <source>an effect with a strength needs a measurement; give its size instead.</source>
        <translation>ein Effekt mit Stärke braucht eine Messung; stattdessen seine Größe angeben.</translation>
    </message>
    <message>
        <source>an error of an effect of the simulation</source>
        <translation>ein Fehler eines Effekts der Simulation</translation>
    </message>
    <message>
        <source>an exposure in us of</source>
        <translation>eine Belichtung in µs von</translation>
    </message>
    <message>
        <source>an expression for at least one of EX, EY, EZ, EA, EB, EC</source>
        <translation>ein Ausdruck für mindestens eine von EX, EY, EZ, EA, EB, EC</translation>
    </message>
    <message>
        <source>an id that no effect of the catalogue has, or &quot;built_in&quot;: false</source>
        <translation>eine Kennung, die kein Effekt des Katalogs hat, oder &quot;built_in&quot;: false</translation>
    </message>
    <message>
        <source>an increment of which at most a million are in {:.6g} s</source>
        <translation>ein Zeitschritt, von dem höchstens eine Million in {:.6g} s passen</translation>
    </message>
    <message>
        <source>an input has missing values inside the range; bridge the gaps or cut the range.</source>
        <translation>einem Eingang fehlen Werte im Bereich; Lücken überbrücken oder den Bereich kürzen.</translation>
    </message>
    <message>
        <source>an input is constant, its effect cannot be learnt; leave it out or use a range in which it changes.</source>
        <translation>ein Eingang ist konstant, seine Wirkung ist nicht lernbar; auslassen oder einen Bereich verwenden, in dem er sich ändert.</translation>
    </message>
    <message>
        <source>an interval of the adaptive compensation is not positive, or the longest is shorter than the shortest.</source>
        <translation>ein Intervall der adaptiven Kompensation ist nicht positiv, oder das längste ist kürzer als das kürzeste.</translation>
    </message>
    <message>
        <source>an object</source>
        <translation>ein Objekt</translation>
    </message>
    <message>
        <source>an option of the choice between methods is empty; allowed: at least one value each.</source>
        <translation>eine Option der Verfahrenswahl ist leer; zulässig: je mindestens ein Wert.</translation>
    </message>
    <message>
        <source>an option of the response fit is an empty list; allowed: at least one value each.</source>
        <translation>eine Option der Anpassung der Antwort ist eine leere Liste; zulässig: je mindestens ein Wert.</translation>
    </message>
    <message>
        <source>an option of the update is negative or zero; allowed: positive sigmas, time constants and bounds.</source>
        <translation>eine Option der Nachführung ist negativ oder null; zulässig: positive Sigmas, Zeitkonstanten und Grenzen.</translation>
    </message>
    <message>
        <source>an origin of the choice must lie between 0 and 1.</source>
        <translation>ein Startpunkt der Wahl muss zwischen 0 und 1 liegen.</translation>
    </message>
    <message>
        <source>an unknown fault</source>
        <translation>ein unbekannter Fehler</translation>
    </message>
    <message>
        <source>and printed nothing</source>
        <translation>und gab nichts aus</translation>
    </message>
    <message>
        <source>and said &quot;{}&quot;</source>
        <translation>und meldete „{}“</translation>
    </message>
    <message>
        <source>and {} more</source>
        <translation>und {} weitere</translation>
    </message>
    <message>
        <source>another log</source>
        <translation>ein anderes Protokoll</translation>
    </message>
    <message>
        <source>another parameter than that of the begin</source>
        <translation>ein anderer Parameter als der des Beginns</translation>
    </message>
    <message>
        <source>answers &quot;{}&quot; to &quot;{}&quot;: another client of linuxcncrsh may be connected, and it can serve one only</source>
        <translation>antwortet „{}“ auf „{}“: möglicherweise ist ein anderer Client von linuxcncrsh verbunden, und es bedient nur einen</translation>
    </message>
    <message>
        <source>applied now</source>
        <translation>jetzt aufgeschaltet</translation>
    </message>
    <message>
        <source>approach direction (0, 0, 0) is not allowed; allowed: a unit vector towards the material.</source>
        <translation>Anfahrrichtung (0, 0, 0) ist nicht zulässig; zulässig: ein Einheitsvektor zum Material hin.</translation>
    </message>
    <message>
        <source>approach direction ({}, {}, {}) has length {:.4g}; allowed: a unit vector.</source>
        <translation>Anfahrrichtung ({}, {}, {}) hat die Länge {:.4g}; zulässig: ein Einheitsvektor.</translation>
    </message>
    <message>
        <source>are missing</source>
        <translation>fehlen</translation>
    </message>
    <message>
        <source>artefact &quot;{}&quot; is not in the machine file; allowed: {}</source>
        <translation>Prüfkörper „{}“ steht nicht in der Maschinendatei; zulässig: {}</translation>
    </message>
    <message>
        <source>artefact &quot;{}&quot; is not in the machine file; allowed: {}.</source>
        <translation>Prüfkörper „{}“ steht nicht in der Maschinendatei; zulässig: {}.</translation>
    </message>
    <message>
        <source>artefact {}</source>
        <translation>Prüfkörper {}</translation>
    </message>
    <message>
        <source>as the source gives it</source>
        <translation>wie von der Quelle angegeben</translation>
    </message>
    <message>
        <source>asked for by the last exceedance</source>
        <translation>verlangt durch die letzte Überschreitung</translation>
    </message>
    <message>
        <source>at every point, predicted without it</source>
        <translation>an jedem Punkt, ohne ihn vorhergesagt</translation>
    </message>
    <message>
        <source>at least 2</source>
        <translation>mindestens 2</translation>
    </message>
    <message>
        <source>at least 4 states and several points</source>
        <translation>mindestens 4 Zustände und mehrere Punkte</translation>
    </message>
    <message>
        <source>at least one artefact</source>
        <translation>mindestens ein Prüfkörper</translation>
    </message>
    <message>
        <source>at least one column</source>
        <translation>mindestens eine Spalte</translation>
    </message>
    <message>
        <source>at least one command, [&quot;program&quot;, &quot;argument&quot;, ..]</source>
        <translation>mindestens ein Befehl, [&quot;program&quot;, &quot;argument&quot;, ..]</translation>
    </message>
    <message>
        <source>at least one component</source>
        <translation>mindestens eine Komponente</translation>
    </message>
    <message>
        <source>at least one driver in a list of inputs that act together</source>
        <translation>mindestens eine Antriebsgröße in einer Liste gemeinsam wirkender Eingänge</translation>
    </message>
    <message>
        <source>at least one effect, or &quot;built_in&quot;: true</source>
        <translation>mindestens ein Effekt oder &quot;built_in&quot;: true</translation>
    </message>
    <message>
        <source>at least one input</source>
        <translation>mindestens ein Eingang</translation>
    </message>
    <message>
        <source>at least one number</source>
        <translation>mindestens eine Zahl</translation>
    </message>
    <message>
        <source>at least one output</source>
        <translation>mindestens ein Ausgang</translation>
    </message>
    <message>
        <source>at least one position</source>
        <translation>mindestens eine Position</translation>
    </message>
    <message>
        <source>at least one segment</source>
        <translation>mindestens ein Abschnitt</translation>
    </message>
    <message>
        <source>at least one source</source>
        <translation>mindestens eine Quelle</translation>
    </message>
    <message>
        <source>at least one template, which takes the parameters</source>
        <translation>mindestens eine Vorlage, die die Parameter aufnimmt</translation>
    </message>
    <message>
        <source>at least {}</source>
        <translation>mindestens {}</translation>
    </message>
    <message>
        <source>at most 60 days</source>
        <translation>höchstens 60 Tage</translation>
    </message>
    <message>
        <source>at most the duration</source>
        <translation>höchstens die Dauer</translation>
    </message>
    <message>
        <source>at the points held out</source>
        <translation>an den Validierungspunkten</translation>
    </message>
    <message>
        <source>at {:g}°</source>
        <translation>bei {:g}°</translation>
    </message>
    <message>
        <source>at {}, held out</source>
        <translation>bei {}, Validierungsdaten</translation>
    </message>
    <message>
        <source>axis &quot;{}&quot; appears twice</source>
        <translation>Achse „{}“ kommt zweimal vor</translation>
    </message>
    <message>
        <source>axis &quot;{}&quot; is not a linear axis of {}; allowed: X, Y or Z that machine.json lists.</source>
        <translation>Achse „{}“ ist keine Linearachse von {}; zulässig: X, Y oder Z, die machine.json aufführt.</translation>
    </message>
    <message>
        <source>axis {} has no compensation channel (limit-{}, offset-{}, comp-{})</source>
        <translation>Achse {} hat keinen Kompensationskanal (limit-{}, offset-{}, comp-{})</translation>
    </message>
    <message>
        <source>axis {} is missing; allowed: an entry with its travel.</source>
        <translation>Achse {} fehlt; zulässig: ein Eintrag mit ihrem Verfahrweg.</translation>
    </message>
    <message>
        <source>axis {}: {:+.1f} µm</source>
        <translation>Achse {}: {:+.1f} µm</translation>
    </message>
    <message>
        <source>axis {}: {:g} mm/s; allowed: up to {:g} mm/s</source>
        <translation>Achse {}: {:g} mm/s; zulässig: bis {:g} mm/s</translation>
    </message>
    <message>
        <source>axis {}: {:g} to {:g} mm; allowed: within +-{:g} mm</source>
        <translation>Achse {}: {:g} bis {:g} mm; zulässig: innerhalb ±{:g} mm</translation>
    </message>
    <message>
        <source>backlash of %1</source>
        <translation>Umkehrspanne von %1</translation>
    </message>
    <message>
        <source>X ball screw</source>
        <translation>Kugelgewindetrieb X</translation>
    </message>
    <message>
        <source>Y ball screw</source>
        <translation>Kugelgewindetrieb Y</translation>
    </message>
    <message>
        <source>Z ball screw</source>
        <translation>Kugelgewindetrieb Z</translation>
    </message>
    <message>
        <source>batch {} &quot;{}&quot; ({}): {} of {}</source>
        <translation>Batch-Auftrag {} „{}“ ({}): {} von {}</translation>
    </message>
    <message>
        <source>Before: {}</source>
        <translation>Vorher: {}</translation>
    </message>
    <message>
        <source>begins at</source>
        <translation>beginnt bei</translation>
    </message>
    <message>
        <source>belongs to the session itself; allowed: the folder into which the instrument writes.</source>
        <translation>gehört zur Sitzung selbst; zulässig: der Ordner, in den das Messgerät schreibt.</translation>
    </message>
    <message>
        <source>below 0.1 % of the prediction</source>
        <translation>unter 0,1 % der Vorhersage</translation>
    </message>
    <message>
        <source>bending of the column towards X</source>
        <translation>Biegung des Ständers in Richtung X</translation>
    </message>
    <message>
        <source>bending of the column towards Y</source>
        <translation>Biegung des Ständers in Richtung Y</translation>
    </message>
    <message>
        <source>blur and noise must not be negative.</source>
        <translation>Unschärfe und Rauschen dürfen nicht negativ sein.</translation>
    </message>
    <message>
        <source>brush, rectangle or lasso</source>
        <translation>brush, rectangle oder lasso</translation>
    </message>
    <message>
        <source>calibrating the profiler</source>
        <translation>Profilsensor wird kalibriert</translation>
    </message>
    <message>
        <source>camera &quot;{}&quot; gives no image; is it connected, and does no other program use it?</source>
        <translation>Kamera „{}“ liefert kein Bild; ist sie angeschlossen und von keinem anderen Programm belegt?</translation>
    </message>
    <message>
        <source>camera &quot;{}&quot; is neither a device number nor a video file; allowed: 0, 1, ..., a file, or an address such as rtsp://host/stream.</source>
        <translation>Kamera „{}“ ist weder Gerätenummer noch Videodatei; zulässig: 0, 1, ..., eine Datei oder eine Adresse wie rtsp://host/stream.</translation>
    </message>
    <message>
        <source>campaign {} of {} has the verdict &quot;{}&quot;</source>
        <translation>Kampagne {} vom {} hat das Urteil „{}“</translation>
    </message>
    <message>
        <source>campaign.json names the simulator {}, which was not run; --simulator {} runs it and looks among its parameters as well.</source>
        <translation>campaign.json nennt den Simulator {}, der nicht ausgeführt wurde; --simulator {} führt ihn aus und sucht auch unter seinen Parametern.</translation>
    </message>
    <message>
        <source>cancelling a batch</source>
        <translation>Batch-Auftrag wird abgebrochen</translation>
    </message>
    <message>
        <source>cannot be asked for a birth</source>
        <translation>kann nicht um ein Birth gebeten werden</translation>
    </message>
    <message>
        <source>cannot be connected</source>
        <translation>lässt sich nicht verbinden</translation>
    </message>
    <message>
        <source>cannot be copied into the session: {}.</source>
        <translation>kann nicht in die Sitzung kopiert werden: {}.</translation>
    </message>
    <message>
        <source>cannot be copied to {}: {}.</source>
        <translation>kann nicht nach {} kopiert werden: {}.</translation>
    </message>
    <message>
        <source>cannot be decided</source>
        <translation>nicht entscheidbar</translation>
    </message>
    <message>
        <source>cannot be made: {}.</source>
        <translation>kann nicht angelegt werden: {}.</translation>
    </message>
    <message>
        <source>cannot be moved away: {}.</source>
        <translation>kann nicht verschoben werden: {}.</translation>
    </message>
    <message>
        <source>cannot be opened</source>
        <translation>lässt sich nicht öffnen</translation>
    </message>
    <message>
        <source>cannot be opened for work: {}; allowed: a folder you may write to.</source>
        <translation>lässt sich nicht zum Arbeiten öffnen: {}; zulässig: ein Ordner mit Schreibrecht.</translation>
    </message>
    <message>
        <source>cannot be read: {}.</source>
        <translation>kann nicht gelesen werden: {}.</translation>
    </message>
    <message>
        <source>cannot be seen on an axis with a linear scale</source>
        <translation>ist an einer Achse mit Längenmesssystem nicht sichtbar</translation>
    </message>
    <message>
        <source>cannot be started ({}; it has to be a program of PATH, or ./name of an included file)</source>
        <translation>lässt sich nicht starten ({}; es muss ein Programm aus PATH sein oder ./Name einer beigefügten Datei)</translation>
    </message>
    <message>
        <source>cannot be started: {}</source>
        <translation>lässt sich nicht starten: {}</translation>
    </message>
    <message>
        <source>cannot be subscribed to</source>
        <translation>lässt sich nicht abonnieren</translation>
    </message>
    <message>
        <source>failed the check. Take them again, or exclude them.</source>
        <translation>haben die Prüfung nicht bestanden. Wiederholen oder ausschließen.</translation>
    </message>
    <message>
        <source>cannot be written as a video.</source>
        <translation>kann nicht als Video geschrieben werden.</translation>
    </message>
    <message>
        <source>cannot be written as a video; allowed: a name ending in .avi.</source>
        <translation>kann nicht als Video geschrieben werden; zulässig: ein Name, der auf .avi endet.</translation>
    </message>
    <message>
        <source>cannot be written: no images.</source>
        <translation>kann nicht geschrieben werden: keine Bilder.</translation>
    </message>
    <message>
        <source>cannot be written: the images differ in size.</source>
        <translation>kann nicht geschrieben werden: die Bilder sind verschieden groß.</translation>
    </message>
    <message>
        <source>cannot be written: {}.</source>
        <translation>kann nicht geschrieben werden: {}.</translation>
    </message>
    <message>
        <source>cannot have this will</source>
        <translation>kann dieses Testament (Will) nicht haben</translation>
    </message>
    <message>
        <source>cannot use its certificates</source>
        <translation>kann seine Zertifikate nicht verwenden</translation>
    </message>
    <message>
        <source>chain &quot;{}&quot;: {}; allowed: {}.</source>
        <translation>Kette „{}“: {}; zulässig: {}.</translation>
    </message>
    <message>
        <source>change / µm, µrad</source>
        <translation>Änderung / µm, µrad</translation>
    </message>
    <message>
        <source>change from state {}; nine-parameter model from {}</source>
        <translation>Änderung gegenüber Zustand {}; Neun-Parameter-Modell aus {}</translation>
    </message>
    <message>
        <source>choosing inputs</source>
        <translation>Eingänge werden gewählt</translation>
    </message>
    <message>
        <source>choosing positions</source>
        <translation>Positionen werden gewählt</translation>
    </message>
    <message>
        <source>chosen in {:.0f} % of the resamples</source>
        <translation>in {:.0f} % der Stichproben gewählt</translation>
    </message>
    <message>
        <source>chosen in {:.0f} % of the resamples for all outputs together</source>
        <translation>in {:.0f} % der Stichproben für alle Ausgänge zusammen gewählt</translation>
    </message>
    <message>
        <source>closed loop</source>
        <translation>geschlossener Regelkreis</translation>
    </message>
    <message>
        <source>closed: move it free</source>
        <translation>geschlossen: freifahren</translation>
    </message>
    <message>
        <source>column &quot;{}&quot; appears twice; allowed: each name once.</source>
        <translation>Spalte „{}“ kommt zweimal vor; zulässig: jeder Name einmal.</translation>
    </message>
    <message>
        <source>column &quot;{}&quot; is missing; found: {}.</source>
        <translation>Spalte „{}“ fehlt; gefunden: {}.</translation>
    </message>
    <message>
        <source>column component</source>
        <translation>Spalte component</translation>
    </message>
    <message>
        <source>column front</source>
        <translation>Ständer vorn</translation>
    </message>
    <message>
        <source>column left</source>
        <translation>Ständer links</translation>
    </message>
    <message>
        <source>column rear</source>
        <translation>Ständer hinten</translation>
    </message>
    <message>
        <source>column right</source>
        <translation>Ständer rechts</translation>
    </message>
    <message>
        <source>column time_s</source>
        <translation>Spalte time_s</translation>
    </message>
    <message>
        <source>column {}</source>
        <translation>Spalte {}</translation>
    </message>
    <message>
        <source>Column {} holds text and was left out.</source>
        <translation>Spalte {} enthält Text und wurde ausgelassen.</translation>
    </message>
    <message>
        <source>column {} is also in {}; allowed: each signal in one file only.</source>
        <translation>Spalte {} ist auch in {}; zulässig: jedes Signal in nur einer Datei.</translation>
    </message>
    <message>
        <source>Column {} is empty and was left out.</source>
        <translation>Spalte {} ist leer und wurde ausgelassen.</translation>
    </message>
    <message>
        <source>comparing priors on blocks left out</source>
        <translation>A-priori-Annahmen werden an ausgelassenen Blöcken verglichen</translation>
    </message>
    <message>
        <source>comparing the scans</source>
        <translation>Scans werden verglichen</translation>
    </message>
    <message>
        <source>compensation = minus the predicted deviation; residual = recorded minus predicted, each in the sign of its column; a reduction is positive where the rms became smaller, negative where it became larger</source>
        <translation>Kompensation = minus die vorhergesagte Abweichung; Residuum = aufgezeichnet minus vorhergesagt, jeweils im Vorzeichen der Spalte; eine Minderung ist positiv, wo der rms kleiner wurde, negativ, wo er größer wurde</translation>
    </message>
    <message>
        <source>compensation: {}</source>
        <translation>Kompensation: {}</translation>
    </message>
    <message>
        <source>component &quot;{}&quot; is not known; allowed: EX, EY, EZ, EA, EB or EC.</source>
        <translation>Komponente „{}“ ist nicht bekannt; zulässig: EX, EY, EZ, EA, EB oder EC.</translation>
    </message>
    <message>
        <source>constant in the training range: its effect cannot be learnt from these data</source>
        <translation>im Trainingsbereich konstant: die Wirkung ist aus diesen Daten nicht lernbar</translation>
    </message>
    <message>
        <source>constant in the training range: its effect cannot be learnt from these data; train on a range in which it changes</source>
        <translation>im Trainingsbereich konstant: die Wirkung ist aus diesen Daten nicht lernbar; in einem Bereich trainieren, in dem er sich ändert</translation>
    </message>
    <message>
        <source>control &quot;{}&quot; is not known; allowed: fanuc, generic, siemens or heidenhain.</source>
        <translation>Steuerung „{}“ ist nicht bekannt; zulässig: fanuc, generic, siemens oder heidenhain.</translation>
    </message>
    <message>
        <source>control limits</source>
        <translation>Eingriffsgrenzen</translation>
    </message>
    <message>
        <source>coolant off</source>
        <translation>Kühlschmierstoff aus</translation>
    </message>
    <message>
        <source>coolant on</source>
        <translation>Kühlschmierstoff ein</translation>
    </message>
    <message>
        <source>copying the campaign into the session</source>
        <translation>Kampagne wird in die Sitzung kopiert</translation>
    </message>
    <message>
        <source>covers only {:.0f} % of the reference (cut short or hidden); evaluated with what is there, with a larger uncertainty.</source>
        <translation>deckt nur {:.0f} % der Referenz ab (abgeschnitten oder verdeckt); mit dem Vorhandenen ausgewertet, mit größerer Unsicherheit.</translation>
    </message>
    <message>
        <source>cross beam</source>
        <translation>Querbalken</translation>
    </message>
    <message>
        <source>crossbeam bottom</source>
        <translation>Querbalken unten</translation>
    </message>
    <message>
        <source>crossbeam top</source>
        <translation>Querbalken oben</translation>
    </message>
    <message>
        <source>d(prediction) / d({}) as the simulation has it</source>
        <translation>d(Vorhersage) / d({}), wie die Simulation sie hat</translation>
    </message>
    <message>
        <source>deviation / {}</source>
        <translation>Abweichung / {}</translation>
    </message>
    <message>
        <source>difference of two nine-parameter models of state {}</source>
        <translation>Differenz zweier Neun-Parameter-Modelle des Zustands {}</translation>
    </message>
    <message>
        <source>digit {} has a point that is not a number.</source>
        <translation>Ziffer {} hat einen Punkt, der keine Zahl ist.</translation>
    </message>
    <message>
        <source>digit {} has no strokes.</source>
        <translation>Ziffer {} hat keine Striche.</translation>
    </message>
    <message>
        <source>digit {} leaves its ellipse at ({}, {}) µm.</source>
        <translation>Ziffer {} verlässt ihre Ellipse bei ({}, {}) um.</translation>
    </message>
    <message>
        <source>digit {} touches its neighbour digit at ({}, {}) µm.</source>
        <translation>Ziffer {} berührt ihre Nachbarziffer bei ({}, {}) um.</translation>
    </message>
    <message>
        <source>direction {} is not allowed; allowed: -1, 0 or +1.</source>
        <translation>Richtung {} ist nicht zulässig; zulässig: -1, 0 oder +1.</translation>
    </message>
    <message>
        <source>Distance {} differs from the certificate by {:.2f} mm: are balls swapped or is this another artefact?</source>
        <translation>Abstand {} weicht um {:.2f} mm vom Kalibrierschein ab: sind Kugeln vertauscht, oder ist dies ein anderer Prüfkörper?</translation>
    </message>
    <message>
        <source>distances between features are 25.4 times too large: the machine file looks like inches; allowed: millimetres in both files.</source>
        <translation>Abstände zwischen Merkmalen sind 25,4-mal zu groß: die Maschinendatei sieht nach Zoll aus; zulässig: Millimeter in beiden Dateien.</translation>
    </message>
    <message>
        <source>distances between features are 25.4 times too small, so positions look like inches; allowed: millimetres.</source>
        <translation>Abstände zwischen Merkmalen sind 25,4-mal zu klein, die Positionen sehen also nach Zoll aus; zulässig: Millimeter.</translation>
    </message>
    <message>
        <source>does not answer</source>
        <translation>antwortet nicht</translation>
    </message>
    <message>
        <source>does not answer within {:g} s</source>
        <translation>antwortet nicht innerhalb von {:g} s</translation>
    </message>
    <message>
        <source>does not change in the setup, so no model can be found; allowed: a longer --setup, or an output that changes.</source>
        <translation>ändert sich in der Anlernphase nicht, ein Modell ist daher nicht zu finden; zulässig: eine längere --setup oder ein Ausgang, der sich ändert.</translation>
    </message>
    <message>
        <source>dof {} is not allowed; allowed: 1, 2 or 3.</source>
        <translation>dof {} ist nicht zulässig; zulässig: 1, 2 oder 3.</translation>
    </message>
    <message>
        <source>drift of the rotary table along {}</source>
        <translation>Drift des Drehtisches entlang {}</translation>
    </message>
    <message>
        <source>drift of the spindle along %1</source>
        <translation>Drift der Spindel entlang %1</translation>
    </message>
    <message>
        <source>drift of the squareness of Y to X</source>
        <translation>Drift der Rechtwinkligkeitsabweichung von Y zu X</translation>
    </message>
    <message>
        <source>drift of {} from {} to {} ({})</source>
        <translation>Drift von {} von {} bis {} ({})</translation>
    </message>
    <message>
        <source>drift {}</source>
        <translation>Drift {}</translation>
    </message>
    <message>
        <source>due for {}, {}</source>
        <translation>fällig seit {}, {}</translation>
    </message>
    <message>
        <source>due on {}, {}</source>
        <translation>fällig am {}, {}</translation>
    </message>
    <message>
        <source>e = -g q (growth from the reference feature, turned by c)</source>
        <translation>e = -g q (Ausdehnung vom Referenzmerkmal aus, um c gedreht)</translation>
    </message>
    <message>
        <source>each driver once among inputs that act together</source>
        <translation>jede Antriebsgröße einmal unter gemeinsam wirkenden Eingängen</translation>
    </message>
    <message>
        <source>each effect once</source>
        <translation>jeder Effekt einmal</translation>
    </message>
    <message>
        <source>each id once</source>
        <translation>jede Kennung einmal</translation>
    </message>
    <message>
        <source>each parameter once</source>
        <translation>jeder Parameter einmal</translation>
    </message>
    <message>
        <source>effect &quot;{}&quot; does nothing in this scenario, so its strength cannot be {}; give a size, or a program and points that excite it.</source>
        <translation>Effekt „{}“ bewirkt in diesem Szenario nichts, seine Stärke kann also nicht {} sein; eine Größe angeben oder ein Programm und Punkte, die ihn anregen.</translation>
    </message>
    <message>
        <source>effect &quot;{}&quot; is accepted and rejected; allowed: one of the two.</source>
        <translation>Effekt „{}“ ist angenommen und verworfen; zulässig: eines von beiden.</translation>
    </message>
    <message>
        <source>effect &quot;{}&quot; is not one that this machine can have; allowed: {}.</source>
        <translation>Effekt „{}“ ist keiner, den diese Maschine haben kann; zulässig: {}.</translation>
    </message>
    <message>
        <source>effect &quot;{}&quot; needs the whole program beforehand.</source>
        <translation>Effekt „{}“ braucht vorab das ganze Programm.</translation>
    </message>
    <message>
        <source>effect &quot;{}&quot; states a strength; a driven machine needs a size.</source>
        <translation>Effekt „{}“ gibt eine Stärke an; eine angetriebene Maschine braucht eine Größe.</translation>
    </message>
    <message>
        <source>effect &quot;{}&quot; {}.</source>
        <translation>Effekt „{}“ {}.</translation>
    </message>
    <message>
        <source>either &quot;column&quot;, a column of log.csv, or &quot;window&quot;, two parameters</source>
        <translation>entweder &quot;column&quot;, eine Spalte von log.csv, oder &quot;window&quot;, zwei Parameter</translation>
    </message>
    <message>
        <source>either size or strength</source>
        <translation>entweder size oder strength</translation>
    </message>
    <message>
        <source>element &apos;{}&apos; stands before the points; allowed: element vertex first.</source>
        <translation>Element &apos;{}&apos; steht vor den Punkten; zulässig: element vertex zuerst.</translation>
    </message>
    <message>
        <source>ellipses are seen ({}), but none of their numbers can be read for certain</source>
        <translation>Ellipsen sind zu sehen ({}), aber keine ihrer Nummern ist sicher lesbar</translation>
    </message>
    <message>
        <source>ended by signal {}</source>
        <translation>durch Signal {} beendet</translation>
    </message>
    <message>
        <source>ended the connection</source>
        <translation>hat die Verbindung beendet</translation>
    </message>
    <message>
        <source>ended with status {}{}</source>
        <translation>endete mit Status {}{}</translation>
    </message>
    <message>
        <source>ended: no control runs here, or another user runs it{}</source>
        <translation>beendet: hier läuft keine Steuerung, oder ein anderer Benutzer betreibt sie{}</translation>
    </message>
    <message>
        <source>ended: {}</source>
        <translation>beendet: {}</translation>
    </message>
    <message>
        <source>ends at</source>
        <translation>endet bei</translation>
    </message>
    <message>
        <source>entering an event</source>
        <translation>Ereignis wird eingetragen</translation>
    </message>
    <message>
        <source>environmental temperature variation error along %1</source>
        <translation>Abweichung durch Änderung der Umgebungstemperatur (ETVE) entlang %1</translation>
    </message>
    <message>
        <source>erase or restore, then brush, rectangle or lasso, then places x,y in mm</source>
        <translation>erase oder restore, dann brush, rectangle oder lasso, dann Stellen x,y in mm</translation>
    </message>
    <message>
        <source>error of {} at all times</source>
        <translation>Fehler von {} zu allen Zeiten</translation>
    </message>
    <message>
        <source>evaluated from the rest</source>
        <translation>aus den übrigen ausgewertet</translation>
    </message>
    <message>
        <source>evaluating touches</source>
        <translation>Antastungen werden ausgewertet</translation>
    </message>
    <message>
        <source>every cycle is relative to the first one, whose noise they share</source>
        <translation>jeder Zyklus ist auf den ersten bezogen, dessen Rauschen sie gemeinsam haben</translation>
    </message>
    <message>
        <source>every id once</source>
        <translation>jede Kennung einmal</translation>
    </message>
    <message>
        <source>every row of this log trained the model: what it does on others is not known</source>
        <translation>jede Zeile dieses Protokolls trainierte das Modell: seine Wirkung bei anderen ist nicht bekannt</translation>
    </message>
    <message>
        <source>every state once</source>
        <translation>jeder Zustand einmal</translation>
    </message>
    <message>
        <source>every {:g} days{}</source>
        <translation>alle {:g} Tage{}</translation>
    </message>
    <message>
        <source>ex = -g q (x - xc), ey = -g q (y - yc)</source>
        <translation>ex = -g q (x - xc), ey = -g q (y - yc)</translation>
    </message>
    <message>
        <source>ex = -g q (y - y0)</source>
        <translation>ex = -g q (y - y0)</translation>
    </message>
    <message>
        <source>exception:</source>
        <translation>Ausnahme:</translation>
    </message>
    <message>
        <source>exception: not done within {:g} s</source>
        <translation>Ausnahme: nicht fertig innerhalb von {:g} s</translation>
    </message>
    <message>
        <source>excluded by the user</source>
        <translation>vom Benutzer ausgeschlossen</translation>
    </message>
    <message>
        <source>expansion of the %1 scale</source>
        <translation>Ausdehnung des Maßstabs %1</translation>
    </message>
    <message>
        <source>expansion of the artefact</source>
        <translation>Ausdehnung des Prüfkörpers</translation>
    </message>
    <message>
        <source>expansion of the column along Z</source>
        <translation>Ausdehnung des Ständers entlang Z</translation>
    </message>
    <message>
        <source>expansion of the table</source>
        <translation>Ausdehnung des Tisches</translation>
    </message>
    <message>
        <source>exposure {:g} us</source>
        <translation>Belichtung {:g} µs</translation>
    </message>
    <message>
        <source>expression &quot;{}&quot; assigns a value or holds text; allowed: an expression in {} that has one value.</source>
        <translation>Ausdruck „{}“ weist einen Wert zu oder enthält Text; zulässig: ein Ausdruck in {} mit einem Wert.</translation>
    </message>
    <message>
        <source>expression &quot;{}&quot; cannot be read ({}); allowed: an expression in {}.</source>
        <translation>Ausdruck „{}“ ist nicht lesbar ({}); zulässig: ein Ausdruck in {}.</translation>
    </message>
    <message>
        <source>expression &quot;{}&quot; has {} values; allowed: one (a comma separates values, it is not a decimal point).</source>
        <translation>Ausdruck „{}“ hat {} Werte; zulässig: einer (ein Komma trennt, es ist kein Dezimalkomma).</translation>
    </message>
    <message>
        <source>expression &quot;{}&quot; holds &quot;{}&quot; at character {}, which is not a variable or function; allowed: {}.</source>
        <translation>Ausdruck „{}“ enthält „{}“ an Zeichen {}, das weder Variable noch Funktion ist; zulässig: {}.</translation>
    </message>
    <message>
        <source>expression &quot;{}&quot; of {} is {} at point {} (x {:g} mm, y {:g} mm, z {:g} mm, c {:g}°); allowed: expressions that are finite at every point observed.</source>
        <translation>Ausdruck „{}“ von {} ist {} am Punkt {} (x {:g} mm, y {:g} mm, z {:g} mm, c {:g}°); zulässig: Ausdrücke, die an jedem beobachteten Punkt endlich sind.</translation>
    </message>
    <message>
        <source>ez = 4 g q s (1 - s), s = (y - y1) / (y2 - y1); EA = slope of ez along y</source>
        <translation>ez = 4 g q s (1 - s), s = (y - y1) / (y2 - y1); EA = Steigung von ez entlang y</translation>
    </message>
    <message>
        <source>ez = g q</source>
        <translation>ez = g q</translation>
    </message>
    <message>
        <source>ez = g q (z - z0) + g&apos; q</source>
        <translation>ez = g q (z - z0) + g&apos; q</translation>
    </message>
    <message>
        <source>ez = g q, q driven by heat x ({} - s0)</source>
        <translation>ez = g q, q angetrieben von Wärme x ({} - s0)</translation>
    </message>
    <message>
        <source>e{0} = g q sin(2 pi {0} / pitch) + g&apos; q cos(2 pi {0} / pitch)</source>
        <translation>e{0} = g q sin(2 pi {0} / pitch) + g&apos; q cos(2 pi {0} / pitch)</translation>
    </message>
    <message>
        <source>e{} = g (1 - exp(-t / tau))</source>
        <translation>e{} = g (1 - exp(-t / tau))</translation>
    </message>
    <message>
        <source>false_alarm_rate {} is not allowed; allowed: above 0, at most 0.2.</source>
        <translation>false_alarm_rate {} ist nicht zulässig; zulässig: über 0, höchstens 0,2.</translation>
    </message>
    <message>
        <source>feature &quot;{}&quot; is not on artefact {}; allowed: {}.</source>
        <translation>Merkmal „{}“ ist nicht auf Prüfkörper {}; zulässig: {}.</translation>
    </message>
    <message>
        <source>feature &quot;{}&quot; is not on {}; allowed: {}</source>
        <translation>Merkmal „{}“ ist nicht auf {}; zulässig: {}</translation>
    </message>
    <message>
        <source>few time constants</source>
        <translation>wenige Zeitkonstanten</translation>
    </message>
    <message>
        <source>fewer than three marks</source>
        <translation>weniger als drei Musterpunkte</translation>
    </message>
    <message>
        <source>fewer than three marks of the pattern could be located.</source>
        <translation>es konnten weniger als drei Musterpunkte gefunden werden.</translation>
    </message>
    <message>
        <source>field {} is a floating-point number of {} bytes; allowed: 4 or 8.</source>
        <translation>Feld {} ist eine Gleitkommazahl von {} Bytes; zulässig: 4 oder 8.</translation>
    </message>
    <message>
        <source>files of the campaign</source>
        <translation>Dateien der Kampagne</translation>
    </message>
    <message>
        <source>filled; centre of circle (i,j) at ({}+{} i, {}+{} j); columns and rows: first index, last index + 1</source>
        <translation>gefüllt; Zentrum des Kreises (i,j) bei ({}+{} i, {}+{} j); Spalten und Zeilen: erster Index, letzter Index + 1</translation>
    </message>
    <message>
        <source>first index, last index + 1</source>
        <translation>erster Index, letzter Index + 1</translation>
    </message>
    <message>
        <source>first-order ARX on two inputs</source>
        <translation>ARX erster Ordnung mit zwei Eingängen</translation>
    </message>
    <message>
        <source>fit / %</source>
        <translation>Fit / %</translation>
    </message>
    <message>
        <source>fit against the interval</source>
        <translation>Fit gegen das Intervall</translation>
    </message>
    <message>
        <source>fit of the residual</source>
        <translation>Anpassung des Residuums</translation>
    </message>
    <message>
        <source>fitting the simulation</source>
        <translation>die Simulation wird angepasst</translation>
    </message>
    <message>
        <source>five-axis machining centre</source>
        <translation>fünfachsiges Bearbeitungszentrum</translation>
    </message>
    <message>
        <source>focus of {} in state {}</source>
        <translation>Fokus von {} in Zustand {}</translation>
    </message>
    <message>
        <source>focus {}</source>
        <translation>Fokus {}</translation>
    </message>
    <message>
        <source>forward by held-out error</source>
        <translation>vorwärts nach dem Fehler der Validierungsdaten</translation>
    </message>
    <message>
        <source>found &apos;{}&apos; in the header; allowed: format, element, property, comment.</source>
        <translation>gefunden &apos;{}&apos; im Kopf; zulässig: format, element, property, comment.</translation>
    </message>
    <message>
        <source>found &apos;{}&apos; in the header; allowed: the entries of PCD 0.7.</source>
        <translation>gefunden &apos;{}&apos; im Kopf; zulässig: die Einträge von PCD 0.7.</translation>
    </message>
    <message>
        <source>found &apos;{}&apos;; allowed: X, Y or Z, the axis that carries the profiler.</source>
        <translation>gefunden &apos;{}&apos;; zulässig: X, Y oder Z, die Achse, die den Profilsensor trägt.</translation>
    </message>
    <message>
        <source>found &apos;{}&apos;; allowed: a number or nan.</source>
        <translation>gefunden &apos;{}&apos;; zulässig: eine Zahl oder nan.</translation>
    </message>
    <message>
        <source>found &apos;{}&apos;; allowed: a whole number from {} to {}.</source>
        <translation>gefunden &apos;{}&apos;; zulässig: eine ganze Zahl von {} bis {}.</translation>
    </message>
    <message>
        <source>found DATA &apos;{}&apos;; allowed: ascii, binary, binary_compressed.</source>
        <translation>gefunden DATA &apos;{}&apos;; zulässig: ascii, binary, binary_compressed.</translation>
    </message>
    <message>
        <source>found SIZE {}; allowed: 1, 2, 4, 8.</source>
        <translation>gefunden SIZE {}; zulässig: 1, 2, 4, 8.</translation>
    </message>
    <message>
        <source>found TYPE &apos;{}&apos;; allowed: F, I, U.</source>
        <translation>gefunden TYPE &apos;{}&apos;; zulässig: F, I, U.</translation>
    </message>
    <message>
        <source>found cycle {} of artefact {} twice; allowed: once.</source>
        <translation>Zyklus {} des Prüfkörpers {} zweimal gefunden; zulässig: einmal.</translation>
    </message>
    <message>
        <source>found extension &apos;{}&apos;; allowed: .pcd, .ply, .csv.</source>
        <translation>gefundene Endung &apos;{}&apos;; zulässig: .pcd, .ply, .csv.</translation>
    </message>
    <message>
        <source>found format &apos;{}&apos;; allowed: ascii, binary_little_endian, binary_big_endian.</source>
        <translation>gefunden Format &apos;{}&apos;; zulässig: ascii, binary_little_endian, binary_big_endian.</translation>
    </message>
    <message>
        <source>found type &apos;{}&apos;; allowed: float, double and integers.</source>
        <translation>gefunden Typ &apos;{}&apos;; zulässig: float, double und ganze Zahlen.</translation>
    </message>
    <message>
        <source>found version &apos;{}&apos;; allowed: 0.7.</source>
        <translation>gefunden Version &apos;{}&apos;; zulässig: 0.7.</translation>
    </message>
    <message>
        <source>found {} after {} for artefact {}; allowed: a time that does not run backwards.</source>
        <translation>{} nach {} für Prüfkörper {} gefunden; zulässig: eine Zeit, die nicht zurückläuft.</translation>
    </message>
    <message>
        <source>four numbers x, y, z, r with r &gt; 0</source>
        <translation>vier Zahlen x, y, z, r mit r &gt; 0</translation>
    </message>
    <message>
        <source>frames that came meanwhile were not counted.</source>
        <translation>inzwischen eingetroffene Bilder wurden nicht gezählt.</translation>
    </message>
    <message>
        <source>front bearing</source>
        <translation>vorderes Lager</translation>
    </message>
    <message>
        <source>front of the column</source>
        <translation>Vorderseite des Ständers</translation>
    </message>
    <message>
        <source>gain {:g}</source>
        <translation>Verstärkung {:g}</translation>
    </message>
    <message>
        <source>gantry milling machine</source>
        <translation>Portalfräsmaschine</translation>
    </message>
    <message>
        <source>gave {} answers to {} questions</source>
        <translation>gab {} Antworten auf {} Fragen</translation>
    </message>
    <message>
        <source>gave {} predictions where it gave {} with other values</source>
        <translation>gab {} Vorhersagen, wo es mit anderen Werten {} gab</translation>
    </message>
    <message>
        <source>genicam:</source>
        <translation>genicam:</translation>
    </message>
    <message>
        <source>gives no resolution_um of axis {}, which this check needs.</source>
        <translation>gibt keine resolution_um der Achse {} an, die diese Prüfung braucht.</translation>
    </message>
    <message>
        <source>group LASSO</source>
        <translation>group LASSO</translation>
    </message>
    <message>
        <source>group {}</source>
        <translation>Gruppe {}</translation>
    </message>
    <message>
        <source>growth of the spindle along Z</source>
        <translation>Ausdehnung der Spindel entlang Z</translation>
    </message>
    <message>
        <source>hal:{}</source>
        <translation>hal:{}</translation>
    </message>
    <message>
        <source>half of the ellipses lie more than {:.1f} px beside where the pattern has them: it is bent or seen from the side, or the lens distorts more than a microscope&apos;s</source>
        <translation>die Hälfte der Ellipsen liegt mehr als {:.1f} px neben ihrem Platz im Muster: es ist verbogen oder von der Seite gesehen, oder das Objektiv verzeichnet stärker als das eines Mikroskops</translation>
    </message>
    <message>
        <source>has a power that is not a number other than zero</source>
        <translation>hat eine Potenz, die keine Zahl ungleich null ist</translation>
    </message>
    <message>
        <source>has a single row, so the cycle time is unknown; give --cycle.</source>
        <translation>hat nur eine Zeile, die Zykluszeit ist daher unbekannt; --cycle angeben.</translation>
    </message>
    <message>
        <source>has another content</source>
        <translation>hat einen anderen Inhalt</translation>
    </message>
    <message>
        <source>has lost its file {}; put it back from a copy of the session.</source>
        <translation>hat die Datei {} verloren; aus einer Kopie der Sitzung zurückholen.</translation>
    </message>
    <message>
        <source>has no X or no Y axis; a heat map needs the travel of both.</source>
        <translation>hat keine X- oder keine Y-Achse; eine Farbkarte braucht den Verfahrweg beider.</translation>
    </message>
    <message>
        <source>has no fiducials to choose from; give a lattice instead.</source>
        <translation>hat keine Messmarken zur Auswahl; stattdessen ein Raster angeben.</translation>
    </message>
    <message>
        <source>has no parameter &quot;{}&quot;; allowed: {}.</source>
        <translation>hat keinen Parameter „{}“; zulässig: {}.</translation>
    </message>
    <message>
        <source>has no point &quot;{}&quot; that could be kept.</source>
        <translation>hat keinen Punkt „{}“, der beibehalten werden könnte.</translation>
    </message>
    <message>
        <source>has no row of parameter {}; allowed: at least one of every parameter of {}.</source>
        <translation>hat keine Zeile des Parameters {}; zulässig: mindestens eine für jeden Parameter von {}.</translation>
    </message>
    <message>
        <source>has no rows.</source>
        <translation>hat keine Zeilen.</translation>
    </message>
    <message>
        <source>has no scans left: all are excluded.</source>
        <translation>hat keine Scans mehr: alle sind ausgeschlossen.</translation>
    </message>
    <message>
        <source>has no signal to model; allowed: at least one column whose name ends in _um or _urad.</source>
        <translation>hat kein modellierbares Signal; zulässig: mindestens eine Spalte, deren Name auf _um oder _urad endet.</translation>
    </message>
    <message>
        <source>has no touches left: all are excluded.</source>
        <translation>hat keine Antastungen mehr: alle sind ausgeschlossen.</translation>
    </message>
    <message>
        <source>has schema version {}, older than this program&apos;s {}; its owner brings it up to date with plant init.</source>
        <translation>hat Schemaversion {}, älter als {} dieses Programms; ihr Eigentümer aktualisiert sie mit plant init.</translation>
    </message>
    <message>
        <source>has schema version {}; allowed: 1 to {}. A newer program has changed it: install the newer version.</source>
        <translation>hat Schemaversion {}; zulässig: 1 bis {}. Ein neueres Programm hat sie geändert: die neuere Version installieren.</translation>
    </message>
    <message>
        <source>has the column {} twice.</source>
        <translation>enthält die Spalte {} zweimal.</translation>
    </message>
    <message>
        <source>has the columns &quot;{}&quot;; allowed for capturing into it: &quot;{}&quot;.</source>
        <translation>hat die Spalten „{}“; zum Aufnehmen zulässig: „{}“.</translation>
    </message>
    <message>
        <source>has the columns &quot;{}&quot;; allowed for going on with it: &quot;{}&quot;, or a new file.</source>
        <translation>hat die Spalten „{}“; zum Fortsetzen zulässig: „{}“ oder eine neue Datei.</translation>
    </message>
    <message>
        <source>has the field {} twice.</source>
        <translation>enthält das Feld {} zweimal.</translation>
    </message>
    <message>
        <source>has {} fields; the header has {}.</source>
        <translation>hat {} Felder; die Kopfzeile hat {}.</translation>
    </message>
    <message>
        <source>has {} values; the header states {} per point.</source>
        <translation>hat {} Werte; der Kopf gibt {} je Punkt an.</translation>
    </message>
    <message>
        <source>have another content</source>
        <translation>haben einen anderen Inhalt</translation>
    </message>
    <message>
        <source>head bottom</source>
        <translation>Spindelkopf unten</translation>
    </message>
    <message>
        <source>head top</source>
        <translation>Spindelkopf oben</translation>
    </message>
    <message>
        <source>head, column, spindle and screws in cycle {} from the ball artefact</source>
        <translation>Spindelkopf, Ständer, Spindel und Kugelgewindetriebe in Zyklus {} aus dem Kugelnormal</translation>
    </message>
    <message>
        <source>heat flow</source>
        <translation>Wärmestrom</translation>
    </message>
    <message>
        <source>displacement along Z by an external heat source</source>
        <translation>Verlagerung entlang Z durch eine äußere Wärmequelle</translation>
    </message>
    <message>
        <source>column bending towards X by an external heat source</source>
        <translation>Biegung des Ständers in Richtung X durch eine äußere Wärmequelle</translation>
    </message>
    <message>
        <source>column bending towards Y by an external heat source</source>
        <translation>Biegung des Ständers in Richtung Y durch eine äußere Wärmequelle</translation>
    </message>
    <message>
        <source>held-out error changes by {:+.0f} % without it; chosen in {:.0f} % of the resamples</source>
        <translation>ohne ihn ändert sich der Fehler der Validierungsdaten um {:+.0f} %; in {:.0f} % der Stichproben gewählt</translation>
    </message>
    <message>
        <source>held-out error would change by {:+.0f} % with it; chosen in {:.0f} % of the resamples</source>
        <translation>mit ihm würde sich der Fehler der Validierungsdaten um {:+.0f} % ändern; in {:.0f} % der Stichproben gewählt</translation>
    </message>
    <message>
        <source>holds a user or a password; allowed: an address without, &quot;user&quot;, and &quot;password_env&quot; or &quot;password_file&quot;.</source>
        <translation>enthält einen Benutzer oder ein Passwort; zulässig: eine Adresse ohne beides, &quot;user&quot; und &quot;password_env&quot; oder &quot;password_file&quot;.</translation>
    </message>
    <message>
        <source>holds fewer than two rows; allowed: a record over time.</source>
        <translation>enthält weniger als zwei Zeilen; zulässig: eine Aufzeichnung über der Zeit.</translation>
    </message>
    <message>
        <source>holds lists or objects more than {} deep in each other; allowed: at most that.</source>
        <translation>enthält mehr als {} ineinander geschachtelte Listen oder Objekte; zulässig: höchstens so viele.</translation>
    </message>
    <message>
        <source>holds no batch {}.</source>
        <translation>enthält keinen Batch-Auftrag {}.</translation>
    </message>
    <message>
        <source>holds no list of captures; allowed: fiducials.csv, touches.csv or scans.csv.</source>
        <translation>enthält keine Liste von Aufnahmen; zulässig: fiducials.csv, touches.csv oder scans.csv.</translation>
    </message>
    <message>
        <source>holds no machine &quot;{}&quot;; allowed: {}.</source>
        <translation>enthält keine Maschine „{}“; zulässig: {}.</translation>
    </message>
    <message>
        <source>holds no observation to be used; allowed: at least one.</source>
        <translation>enthält keine verwendbare Beobachtung; zulässig: mindestens eine.</translation>
    </message>
    <message>
        <source>holds no observation; allowed: at least one row per point.</source>
        <translation>enthält keine Beobachtung; zulässig: mindestens eine Zeile je Punkt.</translation>
    </message>
    <message>
        <source>holds no observation; allowed: at least one state.</source>
        <translation>enthält keine Beobachtung; zulässig: mindestens ein Zustand.</translation>
    </message>
    <message>
        <source>holds no plant store, or none that this role may see; its owner makes one with plant init.</source>
        <translation>enthält keine Werksdatenbank oder keine, die diese Rolle sehen darf; ihr Eigentümer legt sie mit plant init an.</translation>
    </message>
    <message>
        <source>holds no points.</source>
        <translation>enthält keine Punkte.</translation>
    </message>
    <message>
        <source>holds no prediction; allowed: at least one row.</source>
        <translation>enthält keine Vorhersage; zulässig: mindestens eine Zeile.</translation>
    </message>
    <message>
        <source>holds no row to be fitted; allowed: at least one with use fit, at a time that the log covers.</source>
        <translation>enthält keine anzupassende Zeile; zulässig: mindestens eine mit use = fit zu einer Zeit, die das Protokoll abdeckt.</translation>
    </message>
    <message>
        <source>holds no row; allowed: at least one.</source>
        <translation>enthält keine Zeile; zulässig: mindestens eine.</translation>
    </message>
    <message>
        <source>holds no rows; allowed: at least one row.</source>
        <translation>enthält keine Zeilen; zulässig: mindestens eine Zeile.</translation>
    </message>
    <message>
        <source>holds no touches on a sphere; allowed: touches of an artefact of kind balls.</source>
        <translation>enthält keine Antastungen an einer Kugel; zulässig: Antastungen eines Prüfkörpers der Art balls.</translation>
    </message>
    <message>
        <source>holds no touches; allowed: at least one row.</source>
        <translation>enthält keine Antastungen; zulässig: mindestens eine Zeile.</translation>
    </message>
    <message>
        <source>holds no {}; a plan needs at least one.</source>
        <translation>enthält keine {}; ein Plan braucht mindestens eine.</translation>
    </message>
    <message>
        <source>holds nothing measured over time: no displacement in the log, no cycles, no point with {} or more observations; allowed: measure the same points again and again.</source>
        <translation>enthält nichts über der Zeit Gemessenes: keine Verschiebung im Protokoll, keine Zyklen, kein Punkt mit {} oder mehr Beobachtungen; zulässig: dieselben Punkte immer wieder messen.</translation>
    </message>
    <message>
        <source>holds {} points, none of which is a number (all NaN).</source>
        <translation>enthält {} Punkte, von denen keiner eine Zahl ist (alle NaN).</translation>
    </message>
    <message>
        <source>holds {} states; allowed: {}, one for each *STATIC of the template.</source>
        <translation>enthält {} Zustände; zulässig: {}, einer für jedes *STATIC der Vorlage.</translation>
    </message>
    <message>
        <source>homed anew</source>
        <translation>neu referenziert</translation>
    </message>
    <message>
        <source>horizontal machining centre</source>
        <translation>horizontales Bearbeitungszentrum</translation>
    </message>
    <message>
        <source>identical to {}; one of the two is enough</source>
        <translation>identisch mit {}; einer von beiden genügt</translation>
    </message>
    <message>
        <source>identified model</source>
        <translation>identifiziertes Modell</translation>
    </message>
    <message>
        <source>image {} of {}</source>
        <translation>Bild {} von {}</translation>
    </message>
    <message>
        <source>in progress</source>
        <translation>in Arbeit</translation>
    </message>
    <message>
        <source>in the test range the model (rms {:.3g}) is no better than &quot;{}&quot; (rms {:.3g})</source>
        <translation>im Prüfbereich ist das Modell (rms {:.3g}) nicht besser als „{}“ (rms {:.3g})</translation>
    </message>
    <message>
        <source>incremental positions or inches are not allowed</source>
        <translation>Kettenmaße oder Zoll sind nicht zulässig</translation>
    </message>
    <message>
        <source>index {} is not allowed; allowed: a whole number.</source>
        <translation>Index {} ist nicht zulässig; zulässig: eine ganze Zahl.</translation>
    </message>
    <message>
        <source>input {} is a copy of the output; leave it out.</source>
        <translation>Eingang {} ist eine Kopie des Ausgangs; auslassen.</translation>
    </message>
    <message>
        <source>input {} is constant, its effect cannot be learnt; leave it out or use a range in which it changes.</source>
        <translation>Eingang {} ist konstant, seine Wirkung ist nicht lernbar; auslassen oder einen Bereich verwenden, in dem er sich ändert.</translation>
    </message>
    <message>
        <source>inputs {} and {} are identical, so their effects cannot be distinguished; leave one of them out.</source>
        <translation>die Eingänge {} und {} sind identisch, ihre Wirkungen nicht trennbar; einen auslassen.</translation>
    </message>
    <message>
        <source>inside, but the moving average (EWMA) is outside of its own</source>
        <translation>innerhalb, aber der gleitende Mittelwert (EWMA) liegt außerhalb seiner eigenen Grenzen</translation>
    </message>
    <message>
        <source>interval of the on-machine measurements / min</source>
        <translation>Intervall der Messungen auf der Maschine / min</translation>
    </message>
    <message>
        <source>into the simulation: {}</source>
        <translation>in die Simulation: {}</translation>
    </message>
    <message>
        <source>is 0 whenever something was measured, so there is nothing to verify; allowed: a campaign that was measured with the compensation on.</source>
        <translation>ist 0, wann immer etwas gemessen wurde, es gibt also nichts zu verifizieren; zulässig: eine mit eingeschalteter Kompensation gemessene Kampagne.</translation>
    </message>
    <message>
        <source>is a copy of the output {}, so a model with it would only repeat the measurement; leave it out.</source>
        <translation>ist eine Kopie des Ausgangs {}, ein Modell damit würde nur die Messung wiederholen; auslassen.</translation>
    </message>
    <message>
        <source>is a displacement and cannot be a --context; allowed: positions, speeds, temperatures.</source>
        <translation>ist eine Verschiebung und kann kein --context sein; zulässig: Positionen, Drehzahlen, Temperaturen.</translation>
    </message>
    <message>
        <source>is an absolute path</source>
        <translation>ist ein absoluter Pfad</translation>
    </message>
    <message>
        <source>is an empty expression; allowed: an expression in {}.</source>
        <translation>ist ein leerer Ausdruck; zulässig: ein Ausdruck in {}.</translation>
    </message>
    <message>
        <source>is being written by another program; allowed: one at a time.</source>
        <translation>wird gerade von einem anderen Programm geschrieben; zulässig: eines zur gleichen Zeit.</translation>
    </message>
    <message>
        <source>is constant in the training range, so its effect cannot be learnt; leave it out or train on a range in which it changes.</source>
        <translation>ist im Trainingsbereich konstant, seine Wirkung daher nicht lernbar; auslassen oder in einem Bereich trainieren, in dem er sich ändert.</translation>
    </message>
    <message>
        <source>is truncated inside its header: end_header is missing.</source>
        <translation>ist im Kopf abgeschnitten: end_header fehlt.</translation>
    </message>
    <message>
        <source>is damaged: its compressed block does not unpack to the size it states.</source>
        <translation>ist beschädigt: der komprimierte Block ergibt entpackt nicht die angegebene Größe.</translation>
    </message>
    <message>
        <source>is damaged: {} compressed bytes cannot unpack to the {} bytes it states.</source>
        <translation>ist beschädigt: {} komprimierte Bytes können nicht zu den angegebenen {} Bytes entpackt werden.</translation>
    </message>
    <message>
        <source>is empty.</source>
        <translation>ist leer.</translation>
    </message>
    <message>
        <source>is empty; allowed: CSV with one header row.</source>
        <translation>ist leer; zulässig: CSV mit einer Kopfzeile.</translation>
    </message>
    <message>
        <source>is empty; the first row must name x_mm, y_mm and z_mm.</source>
        <translation>ist leer; die erste Zeile muss x_mm, y_mm und z_mm nennen.</translation>
    </message>
    <message>
        <source>is identical to {}, so their effects cannot be distinguished; leave one of them out.</source>
        <translation>ist identisch mit {}, die Wirkungen sind nicht trennbar; einen von beiden auslassen.</translation>
    </message>
    <message>
        <source>is measured at few rows only, and ARX and output error need a value at nearly every one; use the method response (all time constants).</source>
        <translation>ist nur in wenigen Zeilen gemessen, ARX und Ausgangsfehler brauchen fast in jeder einen Wert; das Verfahren response verwenden (alle Zeitkonstanten).</translation>
    </message>
    <message>
        <source>is missing</source>
        <translation>fehlt</translation>
    </message>
    <message>
        <source>is missing or empty; allowed: at least one stylus.</source>
        <translation>fehlt oder ist leer; zulässig: mindestens ein Tastereinsatz.</translation>
    </message>
    <message>
        <source>is missing, so there are no temperatures to predict from; allowed: a campaign with a log.</source>
        <translation>fehlt, daher gibt es keine Temperaturen für eine Vorhersage; zulässig: eine Kampagne mit Protokoll.</translation>
    </message>
    <message>
        <source>is missing, so there is no clock to compare with.</source>
        <translation>fehlt, daher gibt es keine Uhr zum Vergleich.</translation>
    </message>
    <message>
        <source>is missing.</source>
        <translation>fehlt.</translation>
    </message>
    <message>
        <source>is missing; scans cannot be evaluated without it.</source>
        <translation>fehlt; ohne sie sind Scans nicht auswertbar.</translation>
    </message>
    <message>
        <source>is not a PCD file, or is truncated inside its header: the DATA line is missing.</source>
        <translation>ist keine PCD-Datei oder im Kopf abgeschnitten: es fehlt die Zeile DATA.</translation>
    </message>
    <message>
        <source>is no PLY file: it does not start with &apos;ply&apos;.</source>
        <translation>ist keine PLY-Datei: sie beginnt nicht mit &apos;ply&apos;.</translation>
    </message>
    <message>
        <source>is not a ball artefact; allowed here: kind &quot;balls&quot;.</source>
        <translation>ist kein Kugelnormal; hier zulässig: kind &quot;balls&quot;.</translation>
    </message>
    <message>
        <source>is not a bar of holes; allowed here: kind &quot;hole_bar&quot;.</source>
        <translation>ist keine Lochleiste; hier zulässig: kind &quot;hole_bar&quot;.</translation>
    </message>
    <message>
        <source>is not a campaign: it has no campaign.json; allowed: a campaign folder with campaign.json and machine.json. For images, touches or clouds alone begin a new measurement that watches their folder.</source>
        <translation>ist keine Kampagne: campaign.json fehlt; zulässig: ein Kampagnenordner mit campaign.json und machine.json. Für Bilder, Antastungen oder Punktwolken allein eine neue Messung beginnen, die deren Ordner überwacht.</translation>
    </message>
    <message>
        <source>is not a column of log.csv</source>
        <translation>ist keine Spalte von log.csv</translation>
    </message>
    <message>
        <source>is not a component; allowed: EX, EY, EZ, EA, EB or EC.</source>
        <translation>ist keine Komponente; zulässig: EX, EY, EZ, EA, EB oder EC.</translation>
    </message>
    <message>
        <source>is not an effect of the catalogue (EFFECTS.md) and none of {}</source>
        <translation>ist kein Effekt des Katalogs (EFFECTS.md) und keiner von {}</translation>
    </message>
    <message>
        <source>is not a file name</source>
        <translation>ist kein Dateiname</translation>
    </message>
    <message>
        <source>is not a file; allowed: a file that can be appended to.</source>
        <translation>ist keine Datei; zulässig: eine Datei, an die angehängt werden kann.</translation>
    </message>
    <message>
        <source>is not a folder; allowed: the folder into which the instrument writes.</source>
        <translation>ist kein Ordner; zulässig: der Ordner, in den das Messgerät schreibt.</translation>
    </message>
    <message>
        <source>is not a plant store.</source>
        <translation>ist keine Werksdatenbank.</translation>
    </message>
    <message>
        <source>is not a folder; allowed: a campaign folder with campaign.json and machine.json.</source>
        <translation>ist kein Ordner; zulässig: ein Kampagnenordner mit campaign.json und machine.json.</translation>
    </message>
    <message>
        <source>is not a session; allowed: a folder with {}.</source>
        <translation>ist keine Sitzung; zulässig: ein Ordner mit {}.</translation>
    </message>
    <message>
        <source>is not a text file (it contains zero bytes); allowed: CSV in UTF-8.</source>
        <translation>ist keine Textdatei (sie enthält Nullbytes); zulässig: CSV in UTF-8.</translation>
    </message>
    <message>
        <source>is not empty; allowed: a folder that does not exist yet, or an empty one.</source>
        <translation>ist nicht leer; zulässig: ein noch nicht vorhandener oder ein leerer Ordner.</translation>
    </message>
    <message>
        <source>is not empty; allowed: a new folder for the simulation&apos;s new version.</source>
        <translation>ist nicht leer; zulässig: ein neuer Ordner für die neue Version der Simulation.</translation>
    </message>
    <message>
        <source>is not empty; allowed: a new or an empty folder for a new session.</source>
        <translation>ist nicht leer; zulässig: ein neuer oder leerer Ordner für eine neue Sitzung.</translation>
    </message>
    <message>
        <source>is not on the computer {}; allowed: a folder that all computers of the batch see under the same name.</source>
        <translation>ist auf dem Rechner {} nicht vorhanden; zulässig: ein Ordner, den alle Rechner des Batch-Auftrags unter demselben Namen sehen.</translation>
    </message>
    <message>
        <source>is not on this computer; HAL is read where the control runs (package linuxcnc-uspace)</source>
        <translation>ist nicht auf diesem Rechner; HAL wird gelesen, wo die Steuerung läuft (Paket linuxcnc-uspace)</translation>
    </message>
    <message>
        <source>is not the name of a variable (it is not shown, as it may be the password itself); allowed: capital letters, digits and _, such as HALL_PASSWORD, or a variable that is set in the environment.</source>
        <translation>ist kein Variablenname (er wird nicht gezeigt, da er das Passwort selbst sein kann); zulässig: Großbuchstaben, Ziffern und _, etwa HALL_PASSWORD, oder eine gesetzte Umgebungsvariable.</translation>
    </message>
    <message>
        <source>is not there any more (removed, renamed, or the network folder is gone). Nothing was stored; bring the folder back and do the last step again.</source>
        <translation>ist nicht mehr vorhanden (entfernt, umbenannt oder der Netzwerkordner fehlt). Nichts wurde gespeichert; den Ordner zurückholen und den letzten Schritt wiederholen.</translation>
    </message>
    <message>
        <source>is not there.</source>
        <translation>ist nicht vorhanden.</translation>
    </message>
    <message>
        <source>is not there; allowed: a list of images.</source>
        <translation>ist nicht vorhanden; zulässig: eine Liste von Bildern.</translation>
    </message>
    <message>
        <source>is not there; allowed: a plant store (a new one is made with plant init).</source>
        <translation>ist nicht vorhanden; zulässig: eine Werksdatenbank (eine neue legt plant init an).</translation>
    </message>
    <message>
        <source>is not valid JSON ({}).</source>
        <translation>ist kein gültiges JSON ({}).</translation>
    </message>
    <message>
        <source>is not valid JSON here; allowed: JSON (RFC 8259), no NaN.</source>
        <translation>ist hier kein gültiges JSON; zulässig: JSON (RFC 8259), kein NaN.</translation>
    </message>
    <message>
        <source>is of version {} and cannot be copied before it is changed: {}; make room beside it or open it with the older program.</source>
        <translation>hat Version {} und kann vor der Änderung nicht kopiert werden: {}; daneben Platz schaffen oder mit dem älteren Programm öffnen.</translation>
    </message>
    <message>
        <source>is one point too many: the header states {}.</source>
        <translation>ist ein Punkt zu viel: der Kopf gibt {} an.</translation>
    </message>
    <message>
        <source>is open in another window ({}). Close it there first; nothing was changed here.</source>
        <translation>ist in einem anderen Fenster geöffnet ({}). Dort schließen; hier wurde nichts geändert.</translation>
    </message>
    <message>
        <source>is there already and not empty; allowed: a new or an empty folder.</source>
        <translation>ist schon vorhanden und nicht leer; zulässig: ein neuer oder leerer Ordner.</translation>
    </message>
    <message>
        <source>is there already with another content; allowed: a new name for a new capture.</source>
        <translation>ist mit anderem Inhalt schon vorhanden; zulässig: ein neuer Name für eine neue Aufnahme.</translation>
    </message>
    <message>
        <source>is there and not empty; allowed: a new folder.</source>
        <translation>ist vorhanden und nicht leer; zulässig: ein neuer Ordner.</translation>
    </message>
    <message>
        <source>is too large for a compressed PCD (4 GB); allowed: binary.</source>
        <translation>ist zu groß für eine komprimierte PCD-Datei (4 GB); zulässig: binary.</translation>
    </message>
    <message>
        <source>is truncated: the compressed block has {} bytes, the file holds {}.</source>
        <translation>ist abgeschnitten: der komprimierte Block hat {} Bytes, die Datei enthält {}.</translation>
    </message>
    <message>
        <source>is truncated: the header promises {} points of {} bytes, the file holds {:.0f}.</source>
        <translation>ist abgeschnitten: der Kopf verspricht {} Punkte zu {} Bytes, die Datei enthält {:.0f}.</translation>
    </message>
    <message>
        <source>is truncated: the header promises {} points of {} bytes, the file holds {}.</source>
        <translation>ist abgeschnitten: der Kopf verspricht {} Punkte zu {} Bytes, die Datei enthält {}.</translation>
    </message>
    <message>
        <source>is truncated: the header promises {} points, the file holds {}.</source>
        <translation>ist abgeschnitten: der Kopf verspricht {} Punkte, die Datei enthält {}.</translation>
    </message>
    <message>
        <source>is truncated: the sizes of the compressed block are missing.</source>
        <translation>ist abgeschnitten: die Größen des komprimierten Blocks fehlen.</translation>
    </message>
    <message>
        <source>it disagrees with the others by {:.0f} µm</source>
        <translation>sie weicht um {:.0f} µm von den anderen ab</translation>
    </message>
    <message>
        <source>it does not run from w to t</source>
        <translation>sie läuft nicht von w nach t</translation>
    </message>
    <message>
        <source>it is a copy of the output {}, so a model with it would only repeat the measurement; allowed: inputs that are known without measuring the output (temperatures, speeds, feeds, switches).</source>
        <translation>Kopie des Ausgangs {}, ein Modell damit würde nur die Messung wiederholen; zulässig: Eingänge, die ohne Messung des Ausgangs bekannt sind (Temperaturen, Drehzahlen, Vorschübe, Schalter).</translation>
    </message>
    <message>
        <source>it is constant in the training range, there is nothing to model; allowed: an output that changes.</source>
        <translation>im Trainingsbereich konstant, es gibt nichts zu modellieren; zulässig: ein Ausgang, der sich ändert.</translation>
    </message>
    <message>
        <source>it is constant in the training range; allowed: an output that changes.</source>
        <translation>im Trainingsbereich konstant; zulässig: ein Ausgang, der sich ändert.</translation>
    </message>
    <message>
        <source>it is {:.3f} mm away from where the same touch lies in the other cycles</source>
        <translation>sie liegt {:.3f} mm von der Stelle derselben Antastung in den anderen Zyklen entfernt</translation>
    </message>
    <message>
        <source>it is {:.3f} mm away from {}</source>
        <translation>sie liegt {:.3f} mm von {} entfernt</translation>
    </message>
    <message>
        <source>it lies where {} should be, not {}: wrong feature</source>
        <translation>sie liegt, wo {} sein sollte, nicht {}: falsches Merkmal</translation>
    </message>
    <message>
        <source>it moved by {:.0f} µm since {}, more than thermal drift explains</source>
        <translation>sie hat sich seit {1} µm {0:.0f} µm verlagert, mehr als thermische Drift erklärt</translation>
    </message>
    <message>
        <source>it triggered {:.3g} mm from where {} should be touched</source>
        <translation>sie löste {:.3g} mm von der Stelle aus, an der {} angetastet werden soll</translation>
    </message>
    <message>
        <source>it was at work ({})</source>
        <translation>sie in Betrieb war ({})</translation>
    </message>
    <message>
        <source>it was closed</source>
        <translation>sie wurde geschlossen</translation>
    </message>
    <message>
        <source>its centre along {} is open</source>
        <translation>das Zentrum entlang {} ist offen</translation>
    </message>
    <message>
        <source>the centre of its feature cannot be determined</source>
        <translation>das Zentrum seines Merkmals ist nicht bestimmbar</translation>
    </message>
    <message>
        <source>its median is {:.1f}, which looks like kelvin although the name says degC; allowed: degC, or rename the column to end in _K, or give --temperature-unit K.</source>
        <translation>ihr Median ist {:.1f}, das sieht nach Kelvin aus, obwohl der Name degC sagt; zulässig: degC, oder die Spalte auf _K umbenennen, oder --temperature-unit K angeben.</translation>
    </message>
    <message>
        <source>its own values</source>
        <translation>seine eigenen Werte</translation>
    </message>
    <message>
        <source>its part of the prediction is below 0.1 % of the output ({:.2g})</source>
        <translation>sein Anteil an der Vorhersage liegt unter 0,1 % des Ausgangs ({:.2g})</translation>
    </message>
    <message>
        <source>its part of the prediction is {:.2g} rms</source>
        <translation>sein Anteil an der Vorhersage ist {:.2g} rms</translation>
    </message>
    <message>
        <source>its part of the prediction is {:.2g} rms; models with it have {:.0f} % of the weight</source>
        <translation>sein Anteil an der Vorhersage ist {:.2g} rms; Modelle mit ihm haben {:.0f} % des Gewichts</translation>
    </message>
    <message>
        <source>its part of the prediction is {:.2g} rms; without it the error in blocks left out changes by {:+.0f} %</source>
        <translation>sein Anteil an der Vorhersage ist {:.2g} rms; ohne ihn ändert sich der Fehler in ausgelassenen Blöcken um {:+.0f} %</translation>
    </message>
    <message>
        <source>its part of the prediction is {:.2g} rms; without it the kept inputs leave {:.2g} % of the time history of the model with all inputs unexplained, with it {:.2g} %; {}{}</source>
        <translation>sein Anteil an der Vorhersage ist {:.2g} rms; ohne ihn lassen die behaltenen Eingänge {:.2g} % des Verlaufs des Modells mit allen Eingängen übrig, mit ihm {:.2g} %; {}{}</translation>
    </message>
    <message>
        <source>its part of the prediction is {:.2g} rms; {}</source>
        <translation>sein Anteil an der Vorhersage ist {:.2g} rms; {}</translation>
    </message>
    <message>
        <source>its position looks like inches; allowed: millimetres</source>
        <translation>ihre Position sieht nach Zoll aus; zulässig: Millimeter</translation>
    </message>
    <message>
        <source>its radius and its centre along {} are open together</source>
        <translation>Radius und Zentrum entlang {} sind gemeinsam offen</translation>
    </message>
    <message>
        <source>its radius is open</source>
        <translation>der Radius ist offen</translation>
    </message>
    <message>
        <source>its standard uncertainty under the scan model {} is {:.0f} {}: the surface has too little slope or height to show it.</source>
        <translation>die Standardunsicherheit unter dem Scanmodell {} ist {:.0f} {}: die Fläche hat zu wenig Steigung oder Höhe, um sie zu zeigen.</translation>
    </message>
    <message>
        <source>its stream</source>
        <translation>ihr Datenstrom</translation>
    </message>
    <message>
        <source>its time {} s does not come after {} s of the touch before</source>
        <translation>ihre Zeit {} s kommt nicht nach {} s der Antastung davor</translation>
    </message>
    <message>
        <source>judging the inputs</source>
        <translation>Eingänge werden beurteilt</translation>
    </message>
    <message>
        <source>keeps the campaign &quot;{}&quot; in &quot;{}&quot;; allowed: a folder in campaigns.</source>
        <translation>hält die Kampagne „{}“ in „{}“; zulässig: ein Ordner in campaigns.</translation>
    </message>
    <message>
        <source>key &quot;{}&quot; appears twice in one object; allowed: each key once.</source>
        <translation>Schlüssel „{}“ kommt in einem Objekt zweimal vor; zulässig: jeder Schlüssel einmal.</translation>
    </message>
    <message>
        <source>key &quot;{}&quot; is missing.</source>
        <translation>Schlüssel „{}“ fehlt.</translation>
    </message>
    <message>
        <source>lacks FIELDS, SIZE or TYPE.</source>
        <translation>es fehlt FIELDS, SIZE oder TYPE.</translation>
    </message>
    <message>
        <source>lacks WIDTH and POINTS.</source>
        <translation>es fehlen WIDTH und POINTS.</translation>
    </message>
    <message>
        <source>lacks format or element vertex.</source>
        <translation>es fehlt format oder element vertex.</translation>
    </message>
    <message>
        <source>lacks one of {x}, {y}, {z}; allowed: a pattern with all three.</source>
        <translation>es fehlt {x}, {y} oder {z}; zulässig: ein Muster mit allen dreien.</translation>
    </message>
    <message>
        <source>lacks the column {}; needed are x_mm, y_mm and z_mm.</source>
        <translation>es fehlt die Spalte {}; nötig sind x_mm, y_mm und z_mm.</translation>
    </message>
    <message>
        <source>lacks the field {}; needed are x, y and z.</source>
        <translation>es fehlt das Feld {}; nötig sind x, y und z.</translation>
    </message>
    <message>
        <source>leads out of its folder by a link</source>
        <translation>führt über eine Verknüpfung aus dem Ordner hinaus</translation>
    </message>
    <message>
        <source>leave everything at rest for {}</source>
        <translation>alles {} im Stillstand lassen</translation>
    </message>
    <message>
        <source>leaves its folder</source>
        <translation>verlässt den Ordner</translation>
    </message>
    <message>
        <source>left a result that cannot be used ({})</source>
        <translation>hinterließ ein unbrauchbares Ergebnis ({})</translation>
    </message>
    <message>
        <source>left aside</source>
        <translation>beiseitegelegt</translation>
    </message>
    <message>
        <source>left by adaptive</source>
        <translation>Rest, adaptiv</translation>
    </message>
    <message>
        <source>left by static</source>
        <translation>Rest, statisch</translation>
    </message>
    <message>
        <source>left no {} (the log ends with &quot;{}&quot;)</source>
        <translation>hinterließ kein {} (das Protokoll endet mit „{}“)</translation>
    </message>
    <message>
        <source>left side of the column</source>
        <translation>linke Seite des Ständers</translation>
    </message>
    <message>
        <source>level {} is not allowed; allowed: a probability between 0 and 1.</source>
        <translation>Niveau {} ist nicht zulässig; zulässig: eine Wahrscheinlichkeit zwischen 0 und 1.</translation>
    </message>
    <message>
        <source>libcurl does not start.</source>
        <translation>libcurl startet nicht.</translation>
    </message>
    <message>
        <source>lies along {}, but the chain &quot;{}&quot; has no such axis.</source>
        <translation>liegt entlang {}, aber die Kette „{}“ hat keine solche Achse.</translation>
    </message>
    <message>
        <source>lies in the campaign folder, which is never written to; allowed: any other place.</source>
        <translation>liegt im Kampagnenordner, in den nie geschrieben wird; zulässig: jeder andere Ort.</translation>
    </message>
    <message>
        <source>limit and uncertainties of {} must be positive.</source>
        <translation>Grenze und Unsicherheiten von {} müssen positiv sein.</translation>
    </message>
    <message>
        <source>limit exceeded</source>
        <translation>Grenze überschritten</translation>
    </message>
    <message>
        <source>line {}</source>
        <translation>Zeile {}</translation>
    </message>
    <message>
        <source>line {}, {}</source>
        <translation>Zeile {}, {}</translation>
    </message>
    <message>
        <source>lines that were printed meanwhile are not repeated.</source>
        <translation>inzwischen gedruckte Zeilen werden nicht wiederholt.</translation>
    </message>
    <message>
        <source>lists no image; allowed: at least one row.</source>
        <translation>führt kein Bild auf; zulässig: mindestens eine Zeile.</translation>
    </message>
    <message>
        <source>lists no scans.</source>
        <translation>führt keine Scans auf.</translation>
    </message>
    <message>
        <source>log:</source>
        <translation>log:</translation>
    </message>
    <message>
        <source>longest interval without a measurement</source>
        <translation>längstes Intervall ohne Messung</translation>
    </message>
    <message>
        <source>machine as edited</source>
        <translation>Maschine, wie bearbeitet</translation>
    </message>
    <message>
        <source>machine units {}; allowed: MM</source>
        <translation>Maschineneinheiten {}; zulässig: MM</translation>
    </message>
    <message>
        <source>machine.json has no point for {}: the position is taken from the scan, 0 across {}.</source>
        <translation>machine.json hat keinen Punkt für {}: die Position wird aus dem Scan genommen, 0 quer zu {}.</translation>
    </message>
    <message>
        <source>machine.json names no calibration_cloud with its calibration_circle</source>
        <translation>machine.json nennt kein calibration_cloud mit calibration_circle</translation>
    </message>
    <message>
        <source>max_effects {} is not allowed; allowed: 0 to 10.</source>
        <translation>max_effects {} ist nicht zulässig; zulässig: 0 bis 10.</translation>
    </message>
    <message>
        <source>mean of the training range</source>
        <translation>Mittelwert des Trainingsbereichs</translation>
    </message>
    <message>
        <source>measure one point of the machine at rest again and again, or state that the instrument was warm</source>
        <translation>einen Punkt der ruhenden Maschine immer wieder messen oder erklären, dass das Messgerät warm war</translation>
    </message>
    <message>
        <source>measured minus nine parameters</source>
        <translation>gemessen minus neun Parameter</translation>
    </message>
    <message>
        <source>measured minus simulation</source>
        <translation>gemessen minus Simulation</translation>
    </message>
    <message>
        <source>measured minus simulation with effects</source>
        <translation>gemessen minus Simulation mit Effekten</translation>
    </message>
    <message>
        <source>measured values</source>
        <translation>Messwerte</translation>
    </message>
    <message>
        <source>measurement plan</source>
        <translation>Messplan</translation>
    </message>
    <message>
        <source>measuring images</source>
        <translation>Bilder werden vermessen</translation>
    </message>
    <message>
        <source>mirrored in x</source>
        <translation>in x gespiegelt</translation>
    </message>
    <message>
        <source>mirrored in y</source>
        <translation>in y gespiegelt</translation>
    </message>
    <message>
        <source>mm</source>
        <translation>mm</translation>
    </message>
    <message>
        <source>model of {} from {} measurements with {} inputs: {}</source>
        <translation>Modell von {} aus {} Messungen mit {} Eingängen: {}</translation>
    </message>
    <message>
        <source>model of {} identified again with {} inputs: {}</source>
        <translation>Modell von {} neu identifiziert mit {} Eingängen: {}</translation>
    </message>
    <message>
        <source>model of {} identified from {} cycles; {:.2f} µm off where it was not trained</source>
        <translation>Modell von {} aus {} Zyklen identifiziert; {:.2f} µm Abweichung, wo es nicht trainiert wurde</translation>
    </message>
    <message>
        <source>model of {} of {}</source>
        <translation>Modell von {} von {}</translation>
    </message>
    <message>
        <source>models with it have {:.0f} % of the weight of blocked evidence; 5 % are needed</source>
        <translation>Modelle mit ihm haben {:.0f} % des Gewichts der blockweisen Evidenz; 5 % sind nötig</translation>
    </message>
    <message>
        <source>more probable than all sets without it (left beside it: {:.2f} of its size)</source>
        <translation>wahrscheinlicher als alle Mengen ohne ihn (daneben verbleibt: {:.2f} seiner Größe)</translation>
    </message>
    <message>
        <source>more states or more points</source>
        <translation>mehr Zustände oder mehr Punkte</translation>
    </message>
    <message>
        <source>motion seen in {}, correlation {:.3f}</source>
        <translation>Bewegung in {} gesehen, Korrelation {:.3f}</translation>
    </message>
    <message>
        <source>names a point that the machine does not have</source>
        <translation>nennt einen Punkt, den die Maschine nicht hat</translation>
    </message>
    <message>
        <source>names no simulation to compare with; allowed: &quot;simulation&quot;: &quot;simulation.csv&quot;, &quot;model.json&quot; or &quot;fe.json&quot;.</source>
        <translation>nennt keine Simulation zum Vergleich; zulässig: &quot;simulation&quot;: &quot;simulation.csv&quot;, &quot;model.json&quot; oder &quot;fe.json&quot;.</translation>
    </message>
    <message>
        <source>names no simulator that something could be put into; allowed: &quot;simulator&quot;: &quot;simulator.json&quot;, or --simulator FILE.</source>
        <translation>nennt keinen Simulator, in den etwas eingesetzt werden könnte; zulässig: &quot;simulator&quot;: &quot;simulator.json&quot; oder --simulator FILE.</translation>
    </message>
    <message>
        <source>needs &quot;hole_diameter_mm&quot; to plan touches.</source>
        <translation>braucht &quot;hole_diameter_mm&quot;, um Antastungen zu planen.</translation>
    </message>
    <message>
        <source>needs a ball screw on that axis (drive.type)</source>
        <translation>braucht einen Kugelgewindetrieb an dieser Achse (drive.type)</translation>
    </message>
    <message>
        <source>needs a column (column.base_mm)</source>
        <translation>braucht einen Ständer (column.base_mm)</translation>
    </message>
    <message>
        <source>needs a crossbeam (crossbeam)</source>
        <translation>braucht einen Querbalken (crossbeam)</translation>
    </message>
    <message>
        <source>needs a linear scale on that axis (scale)</source>
        <translation>braucht ein Längenmesssystem an dieser Achse (scale)</translation>
    </message>
    <message>
        <source>needs a rotary axis (rotary)</source>
        <translation>braucht eine Drehachse (rotary)</translation>
    </message>
    <message>
        <source>needs a rotary axis that turns the workpiece across the bar, but the chain &quot;{}&quot; has none; allowed: for example &quot;V [w-C&apos;-X&apos;-b-Y-Z-(C1)-t]&quot;.</source>
        <translation>braucht eine Drehachse, die das Werkstück quer zur Leiste dreht, aber die Kette „{}“ hat keine; zulässig: zum Beispiel &quot;V [w-C&apos;-X&apos;-b-Y-Z-(C1)-t]&quot;.</translation>
    </message>
    <message>
        <source>needs a stylus; allowed: &quot;styli&quot; in the machine file.</source>
        <translation>braucht einen Tastereinsatz; zulässig: &quot;styli&quot; in der Maschinendatei.</translation>
    </message>
    <message>
        <source>needs an artefact (artefacts)</source>
        <translation>braucht einen Prüfkörper (artefacts)</translation>
    </message>
    <message>
        <source>needs an axis that the machine does not have</source>
        <translation>braucht eine Achse, die die Maschine nicht hat</translation>
    </message>
    <message>
        <source>needs the centre of the rotary axis {}; allowed: &quot;rotary&quot;:[{{&quot;name&quot;:&quot;{}&quot;,&quot;centre_mm&quot;:[x,y,z]}}] in the machine file.</source>
        <translation>braucht das Zentrum der Drehachse {}; zulässig: &quot;rotary&quot;:[{{&quot;name&quot;:&quot;{}&quot;,&quot;centre_mm&quot;:[x,y,z]}}] in der Maschinendatei.</translation>
    </message>
    <message>
        <source>needs the pitch of the screw (drive.pitch_mm)</source>
        <translation>braucht die Steigung des Kugelgewindetriebs (drive.pitch_mm)</translation>
    </message>
    <message>
        <source>neighbouring circles touch.</source>
        <translation>benachbarte Kreise berühren sich.</translation>
    </message>
    <message>
        <source>neighbouring ellipses touch: semi-axis plus half the line is {} µm, half the pitch {} µm.</source>
        <translation>benachbarte Ellipsen berühren sich: Halbachse plus halbe Linie ist {} µm, halbes Raster {} µm.</translation>
    </message>
    <message>
        <source>neither accepts nor refuses &quot;set {}&quot;</source>
        <translation>nimmt „set {}“ weder an noch lehnt es ab</translation>
    </message>
    <message>
        <source>never changes, so no gain can depend on it; allowed: a --context that changes.</source>
        <translation>ändert sich nie, keine Verstärkung kann davon abhängen; zulässig: ein --context, der sich ändert.</translation>
    </message>
    <message>
        <source>never measured</source>
        <translation>nie gemessen</translation>
    </message>
    <message>
        <source>never measured, {}</source>
        <translation>nie gemessen, {}</translation>
    </message>
    <message>
        <source>nine parameters</source>
        <translation>neun Parameter</translation>
    </message>
    <message>
        <source>nine-parameter model from {}</source>
        <translation>Neun-Parameter-Modell aus {}</translation>
    </message>
    <message>
        <source>nine-parameter model of {}</source>
        <translation>Neun-Parameter-Modell von {}</translation>
    </message>
    <message>
        <source>no [ ... ]</source>
        <translation>kein [ ... ]</translation>
    </message>
    <message>
        <source>no address</source>
        <translation>keine Adresse</translation>
    </message>
    <message>
        <source>No ambient temperature was named (--ambient): nothing is given per K.</source>
        <translation>Es wurde keine Umgebungstemperatur angegeben (--ambient): nichts wird je K angegeben.</translation>
    </message>
    <message>
        <source>no answer within {:.0f} s</source>
        <translation>keine Antwort innerhalb von {:.0f} s</translation>
    </message>
    <message>
        <source>no choice of {} positions among the candidates keeps {:g} mm between any two</source>
        <translation>keine Wahl von {} Positionen unter den Kandidaten hält {:g} mm zwischen je zweien ein</translation>
    </message>
    <message>
        <source>no common event was found: the best correlation is {:.2f}; allowed: records of the same motion with a correlation of at least 0.6.</source>
        <translation>kein gemeinsames Ereignis gefunden: die beste Korrelation ist {:.2f}; zulässig: Aufzeichnungen derselben Bewegung mit einer Korrelation von mindestens 0,6.</translation>
    </message>
    <message>
        <source>no convergence</source>
        <translation>keine Konvergenz</translation>
    </message>
    <message>
        <source>No displacement could be measured: see the rejected captures.</source>
        <translation>Es konnte keine Verschiebung gemessen werden: siehe die verworfenen Aufnahmen.</translation>
    </message>
    <message>
        <source>no displacement of state {} can be fitted; allowed: rows EX, EY or EZ with use fit{}.</source>
        <translation>keine Verschiebung des Zustands {} ist anpassbar; zulässig: Zeilen EX, EY oder EZ mit use = fit{}.</translation>
    </message>
    <message>
        <source>no displacement was given; allowed: at least one column whose name ends in _um or _urad.</source>
        <translation>es wurde keine Verschiebung angegeben; zulässig: mindestens eine Spalte, deren Name auf _um oder _urad endet.</translation>
    </message>
    <message>
        <source>no effect of the model can be fitted to these observations; choose others.</source>
        <translation>kein Effekt des Modells ist an diese Beobachtungen anpassbar; andere wählen.</translation>
    </message>
    <message>
        <source>no effects</source>
        <translation>keine Effekte</translation>
    </message>
    <message>
        <source>no ellipses of the pattern were found ({} x {} px, levels {:.0f} to {:.0f})</source>
        <translation>es wurden keine Ellipsen des Musters gefunden ({} x {} px, Grauwerte {:.0f} bis {:.0f})</translation>
    </message>
    <message>
        <source>no error was named; allowed: at least one measured column.</source>
        <translation>es wurde keine Abweichung angegeben; zulässig: mindestens eine gemessene Spalte.</translation>
    </message>
    <message>
        <source>no errors of sensors: the virtual machine makes its own temperatures and reads none of log.csv</source>
        <translation>keine Sensorfehler: die virtuelle Maschine erzeugt ihre Temperaturen selbst und liest keine aus log.csv</translation>
    </message>
    <message>
        <source>No fiducial could be evaluated.</source>
        <translation>Es konnte keine Messmarke ausgewertet werden.</translation>
    </message>
    <message>
        <source>No fiducial has a {} in {}: its change is relative to {}.</source>
        <translation>Keine Messmarke hat {} in {}: die Änderung bezieht sich auf {}.</translation>
    </message>
    <message>
        <source>No images along X or Y could be used: displacements in the plane cannot be turned into the machine&apos;s axes and are left out.</source>
        <translation>Es waren keine Bilder entlang X oder Y verwendbar: Verschiebungen in der Ebene lassen sich nicht in die Maschinenachsen umrechnen und entfallen.</translation>
    </message>
    <message>
        <source>no images along the machine&apos;s X or Y axis could be used</source>
        <translation>es waren keine Bilder entlang der X- oder Y-Achse der Maschine verwendbar</translation>
    </message>
    <message>
        <source>no input can be used: {}; allowed: at least one input that changes in the training range.</source>
        <translation>kein Eingang ist verwendbar: {}; zulässig: mindestens ein Eingang, der sich im Trainingsbereich ändert.</translation>
    </message>
    <message>
        <source>no input explains anything of the output in the training range; give other inputs.</source>
        <translation>kein Eingang erklärt etwas vom Ausgang im Trainingsbereich; andere Eingänge angeben.</translation>
    </message>
    <message>
        <source>no interval known</source>
        <translation>kein Intervall bekannt</translation>
    </message>
    <message>
        <source>no line matches the pattern &quot;{}&quot;; allowed: text printed by the measuring program, or another template.</source>
        <translation>keine Zeile entspricht dem Muster „{}“; zulässig: vom Messprogramm gedruckter Text oder eine andere Vorlage.</translation>
    </message>
    <message>
        <source>no model</source>
        <translation>kein Modell</translation>
    </message>
    <message>
        <source>no model of {} yet: {}</source>
        <translation>noch kein Modell von {}: {}</translation>
    </message>
    <message>
        <source>no order could be fitted to these samples; allowed: a longer range or fewer inputs.</source>
        <translation>keine Ordnung war an diese Abtastwerte anpassbar; zulässig: ein längerer Bereich oder weniger Eingänge.</translation>
    </message>
    <message>
        <source>no part that an effect follows</source>
        <translation>kein Teil, dem ein Effekt folgt</translation>
    </message>
    <message>
        <source>no pipe: {}.</source>
        <translation>keine Pipe: {}.</translation>
    </message>
    <message>
        <source>no point was held out, and none can be left out: how the correction does elsewhere is not known</source>
        <translation>es gibt keine Validierungspunkte, und keiner kann ausgelassen werden: wie die Korrektur anderswo wirkt, ist nicht bekannt</translation>
    </message>
    <message>
        <source>no reason given</source>
        <translation>kein Grund angegeben</translation>
    </message>
    <message>
        <source>no row lies from {:g} to {:g} s; allowed: a part of {:g} to {:g} s.</source>
        <translation>keine Zeile liegt zwischen {:g} und {:g} s; zulässig: ein Teil von {:g} bis {:g} s.</translation>
    </message>
    <message>
        <source>no set of focus images could be used</source>
        <translation>kein Satz von Fokusbildern war verwendbar</translation>
    </message>
    <message>
        <source>no table, there is none</source>
        <translation>keine Tabelle, es gibt keine</translation>
    </message>
    <message>
        <source>no temperature changes in the training range</source>
        <translation>keine Temperatur ändert sich im Trainingsbereich</translation>
    </message>
    <message>
        <source>no temperature of the file is ever below 50 (median here {:.1f}), which looks like Fahrenheit although the name says degC; allowed: degC, or rename the columns to end in _degF, or give --temperature-unit degF (or degC if they really are that hot).</source>
        <translation>keine Temperatur der Datei liegt je unter 50 (Median hier {:.1f}), das sieht nach Fahrenheit aus, obwohl der Name degC sagt; zulässig: degC, oder die Spalten auf _degF umbenennen, oder --temperature-unit degF angeben (oder degC, wenn sie wirklich so heiß sind).</translation>
    </message>
    <message>
        <source>no touch on the surface; its height is open</source>
        <translation>keine Antastung auf der Fläche; ihre Höhe ist offen</translation>
    </message>
    <message>
        <source>no value of {} is measured from {:.6g} s on.</source>
        <translation>ab {1:.6g} s ist kein Wert von {0} gemessen.</translation>
    </message>
    <message>
        <source>nobody is there to accept what was named</source>
        <translation>niemand ist da, um das Benannte anzunehmen</translation>
    </message>
    <message>
        <source>noise time constant, speed freedom and period must be positive (period 0: automatic).</source>
        <translation>Rauschzeitkonstante, Drehzahlfreiheit und Periode müssen positiv sein (Periode 0: automatisch).</translation>
    </message>
    <message>
        <source>none given</source>
        <translation>keine angegeben</translation>
    </message>
    <message>
        <source>none is described</source>
        <translation>keiner ist beschrieben</translation>
    </message>
    <message>
        <source>none yet, none of its results has any</source>
        <translation>noch keine, keines ihrer Ergebnisse hat welche</translation>
    </message>
    <message>
        <source>none yet, publish a campaign of it first</source>
        <translation>noch keine, zuerst eine Kampagne davon veröffentlichen</translation>
    </message>
    <message>
        <source>not a number</source>
        <translation>keine Zahl</translation>
    </message>
    <message>
        <source>not accepted: {}</source>
        <translation>nicht angenommen: {}</translation>
    </message>
    <message>
        <source>not begun</source>
        <translation>nicht begonnen</translation>
    </message>
    <message>
        <source>not described</source>
        <translation>nicht beschrieben</translation>
    </message>
    <message>
        <source>not determined</source>
        <translation>nicht bestimmt</translation>
    </message>
    <message>
        <source>not determined by the touches that are there:</source>
        <translation>durch die vorhandenen Antastungen nicht bestimmt:</translation>
    </message>
    <message>
        <source>not judged</source>
        <translation>nicht beurteilt</translation>
    </message>
    <message>
        <source>not measured in this log,</source>
        <translation>in diesem Protokoll nicht gemessen,</translation>
    </message>
    <message>
        <source>not met</source>
        <translation>nicht erreicht</translation>
    </message>
    <message>
        <source>not passed</source>
        <translation>nicht bestanden</translation>
    </message>
    <message>
        <source>not run</source>
        <translation>nicht ausgeführt</translation>
    </message>
    <message>
        <source>not started</source>
        <translation>nicht begonnen</translation>
    </message>
    <message>
        <source>note: {}</source>
        <translation>Hinweis: {}</translation>
    </message>
    <message>
        <source>nothing asks whether the probe triggered</source>
        <translation>nichts fragt ab, ob der Messtaster ausgelöst hat</translation>
    </message>
    <message>
        <source>nothing can be compared: no point and component was measured in at least two states both before and after; allowed: the same plan measured again with the compensation on.</source>
        <translation>nichts ist vergleichbar: kein Punkt und keine Komponente wurde vorher und nachher in mindestens zwei Zuständen gemessen; zulässig: derselbe Plan, mit eingeschalteter Kompensation erneut gemessen.</translation>
    </message>
    <message>
        <source>nothing can be compared: the points of the same name are elsewhere than before; allowed: the same plan measured again on the same machine.</source>
        <translation>nichts ist vergleichbar: gleichnamige Punkte liegen woanders als zuvor; zulässig: derselbe Plan, an derselben Maschine erneut gemessen.</translation>
    </message>
    <message>
        <source>nothing is added to the simulation</source>
        <translation>nichts wird zur Simulation hinzugefügt</translation>
    </message>
    <message>
        <source>nothing is to be seen in the image (mean level {:.0f} of 255).</source>
        <translation>im Bild ist nichts zu sehen (mittlerer Grauwert {:.0f} von 255).</translation>
    </message>
    <message>
        <source>nothing logged</source>
        <translation>nichts Protokolliertes</translation>
    </message>
    <message>
        <source>nothing of this state was held out: how the correction does elsewhere is not known</source>
        <translation>von diesem Zustand gibt es keine Validierungsdaten: wie die Korrektur anderswo wirkt, ist nicht bekannt</translation>
    </message>
    <message>
        <source>Nothing was measured along {}: no component error of that axis is stated, and there is no screw compensation for it.</source>
        <translation>Entlang {} wurde nichts gemessen: keine Komponentenabweichung dieser Achse wird angegeben, und es gibt keine Spindelsteigungskompensation für sie.</translation>
    </message>
    <message>
        <source>nut {}</source>
        <translation>Mutter {}</translation>
    </message>
    <message>
        <source>Observed rotations are left out: the nine parameters are fitted to displacements.</source>
        <translation>Beobachtete Drehungen bleiben außer Betracht: die neun Parameter werden an Verschiebungen angepasst.</translation>
    </message>
    <message>
        <source>of known radius</source>
        <translation>mit bekanntem Radius</translation>
    </message>
    <message>
        <source>off, fading from {}: {}</source>
        <translation>aus, klingt ab von {}: {}</translation>
    </message>
    <message>
        <source>offsets of the clocks</source>
        <translation>Uhrversatz</translation>
    </message>
    <message>
        <source>on the fitted states</source>
        <translation>an den angepassten Zuständen</translation>
    </message>
    <message>
        <source>on the held-out states</source>
        <translation>an den Validierungsdaten</translation>
    </message>
    <message>
        <source>on-machine measurements after the setup</source>
        <translation>Messungen auf der Maschine nach der Anlernphase</translation>
    </message>
    <message>
        <source>one centre for all</source>
        <translation>ein Zentrum für alle</translation>
    </message>
    <message>
        <source>one centre per fiducial and state</source>
        <translation>ein Zentrum je Messmarke und Zustand</translation>
    </message>
    <message>
        <source>one centre per state</source>
        <translation>ein Zentrum je Zustand</translation>
    </message>
    <message>
        <source>One cycle alone is the reference; thermal errors need a second one</source>
        <translation>Ein Zyklus allein ist die Referenz; thermische Abweichungen brauchen einen zweiten</translation>
    </message>
    <message>
        <source>one direction</source>
        <translation>eine Richtung</translation>
    </message>
    <message>
        <source>one direction of the camera for all</source>
        <translation>eine Richtung der Kamera für alle</translation>
    </message>
    <message>
        <source>one of &quot;campaigns&quot; and &quot;seeds&quot;</source>
        <translation>eines von &quot;campaigns&quot; und &quot;seeds&quot;</translation>
    </message>
    <message>
        <source>one place or more for a brush, two for a rectangle, three or more for a lasso</source>
        <translation>mindestens eine Stelle für brush, zwei für rectangle, drei oder mehr für lasso</translation>
    </message>
    <message>
        <source>only {:.0f} % of the points of the fullest scan of {}: cut short or hidden</source>
        <translation>nur {:.0f} % der Punkte des vollsten Scans von {}: abgeschnitten oder verdeckt</translation>
    </message>
    <message>
        <source>only {} ellipses of the pattern were decoded; at least {} are needed</source>
        <translation>nur {} Ellipsen des Musters wurden decodiert; mindestens {} sind nötig</translation>
    </message>
    <message>
        <source>only {} of {} coefficients are determined: inputs tell the same or do not move enough; give fewer inputs or a lower order.</source>
        <translation>nur {} von {} Koeffizienten sind bestimmt: Eingänge sagen dasselbe oder ändern sich zu wenig; weniger Eingänge oder eine niedrigere Ordnung angeben.</translation>
    </message>
    <message>
        <source>only {} of {} observations have a prediction in the simulation{}; allowed: at least half.</source>
        <translation>nur {} von {} Beobachtungen haben eine Vorhersage in der Simulation{}; zulässig: mindestens die Hälfte.</translation>
    </message>
    <message>
        <source>or of the catalogue</source>
        <translation>oder des Katalogs</translation>
    </message>
    <message>
        <source>other cycles have it; take it again</source>
        <translation>andere Zyklen haben sie; erneut aufnehmen</translation>
    </message>
    <message>
        <source>output &quot;{}</source>
        <translation>Ausgang „{}</translation>
    </message>
    <message>
        <source>Output error: {} ({})</source>
        <translation>Ausgangsfehler: {} ({})</translation>
    </message>
    <message>
        <source>p not determined</source>
        <translation>p nicht bestimmt</translation>
    </message>
    <message>
        <source>parameter &quot;{}&quot; is not known; allowed: {}.</source>
        <translation>Parameter „{}“ ist nicht bekannt; zulässig: {}.</translation>
    </message>
    <message>
        <source>parameter {} cannot be {}; allowed: {} to {}{}{}.</source>
        <translation>Parameter {} kann nicht {} sein; zulässig: {} bis {}{}{}.</translation>
    </message>
    <message>
        <source>pass {}: {}</source>
        <translation>Durchgang {}: {}</translation>
    </message>
    <message>
        <source>peak to peak against the interval</source>
        <translation>Spitze-Spitze gegen das Intervall</translation>
    </message>
    <message>
        <source>periodic error of the %1 ball screw</source>
        <translation>periodische Abweichung des Kugelgewindetriebs %1</translation>
    </message>
    <message>
        <source>pixel lengths from {} to {} µm are not allowed; 0 &lt; smallest &lt; largest is needed.</source>
        <translation>Pixelgrößen von {} bis {} µm sind nicht zulässig; nötig ist 0 &lt; kleinste &lt; größte.</translation>
    </message>
    <message>
        <source>place ({}, {}, {}) mm</source>
        <translation>Stelle ({}, {}, {}) mm</translation>
    </message>
    <message>
        <source>place &quot;{}&quot; is not a body of the virtual machine; allowed: room, coolant, front bearing, rear bearing, shaft, spindle housing, head top, head bottom, column front, column rear, column left, column right, table, screw x, nut x, screw bearing x, scale x (or y, z), crossbeam top, crossbeam bottom, pedestal, bed, rotary drive, artefact, each row also with @0 ... @1.</source>
        <translation>Ort „{}“ ist kein Körper der virtuellen Maschine; zulässig: room, coolant, front bearing, rear bearing, shaft, spindle housing, head top, head bottom, column front, column rear, column left, column right, table, screw x, nut x, screw bearing x, scale x (oder y, z), crossbeam top, crossbeam bottom, pedestal, bed, rotary drive, artefact, jede Reihe auch mit @0 ... @1.</translation>
    </message>
    <message>
        <source>place &quot;{}&quot;: the position after @ is not a number from 0 to 1.</source>
        <translation>Ort „{}“: die Position nach @ ist keine Zahl von 0 bis 1.</translation>
    </message>
    <message>
        <source>place {{{}}} is not known; allowed: {}.</source>
        <translation>Platzhalter {{{}}} ist nicht bekannt; zulässig: {}.</translation>
    </message>
    <message>
        <source>places as x,y in mm</source>
        <translation>Stellen als x,y in mm</translation>
    </message>
    <message>
        <source>plan of the batch</source>
        <translation>Plan des Batch-Auftrags</translation>
    </message>
    <message>
        <source>point &quot;{}&quot; is not there; allowed: {}.</source>
        <translation>Punkt „{}“ ist nicht vorhanden; zulässig: {}.</translation>
    </message>
    <message>
        <source>point &quot;{}&quot; was not measured in state {}; allowed: {}.</source>
        <translation>Punkt „{}“ wurde in Zustand {} nicht gemessen; zulässig: {}.</translation>
    </message>
    <message>
        <source>points of kind &quot;fiducial&quot;</source>
        <translation>Punkte der Art &quot;fiducial&quot;</translation>
    </message>
    <message>
        <source>points of kind &quot;surface&quot;</source>
        <translation>Punkte der Art &quot;surface&quot;</translation>
    </message>
    <message>
        <source>position in the plane</source>
        <translation>Position in der Ebene</translation>
    </message>
    <message>
        <source>position {} mm was measured {} times; allowed: at least 4 times over the test.</source>
        <translation>Position {} mm wurde {}-mal gemessen; zulässig: mindestens 4-mal über die Prüfung.</translation>
    </message>
    <message>
        <source>positions reach {:.6g} although the longest travel is {:.6g} mm; allowed: millimetres (are these micrometres?).</source>
        <translation>Positionen reichen bis {:.6g}, obwohl der längste Verfahrweg {:.6g} mm ist; zulässig: Millimeter (sind das Mikrometer?).</translation>
    </message>
    <message>
        <source>postgresql:{}</source>
        <translation>postgresql:{}</translation>
    </message>
    <message>
        <source>printed without an end</source>
        <translation>gab endlos aus</translation>
    </message>
    <message>
        <source>probe and reference agree</source>
        <translation>Messtaster und Referenz stimmen überein</translation>
    </message>
    <message>
        <source>probing a hole bar needs a machine with a rotary axis (rotary).</source>
        <translation>das Antasten einer Lochleiste braucht eine Maschine mit Drehachse (rotary).</translation>
    </message>
    <message>
        <source>programs need a table that rotates about Z.</source>
        <translation>Programme brauchen einen Tisch, der um Z dreht.</translation>
    </message>
    <message>
        <source>added by the user</source>
        <translation>vom Benutzer hinzugefügt</translation>
    </message>
    <message>
        <source>added by the user; the data do not support it</source>
        <translation>vom Benutzer hinzugefügt; die Daten stützen es nicht</translation>
    </message>
    <message>
        <source>radial growth of the rotary table</source>
        <translation>radiale Ausdehnung des Drehtisches</translation>
    </message>
    <message>
        <source>range in the control</source>
        <translation>Bereich in der Steuerung</translation>
    </message>
    <message>
        <source>rank tolerance {} is not allowed; allowed: between 0 and 1.</source>
        <translation>Rangtoleranz {} ist nicht zulässig; zulässig: zwischen 0 und 1.</translation>
    </message>
    <message>
        <source>reading scans</source>
        <translation>Scans werden gelesen</translation>
    </message>
    <message>
        <source>reading the campaign</source>
        <translation>die Kampagne wird gelesen</translation>
    </message>
    <message>
        <source>reading the files</source>
        <translation>Dateien werden gelesen</translation>
    </message>
    <message>
        <source>reading the reference</source>
        <translation>Referenz wird gelesen</translation>
    </message>
    <message>
        <source>reading the scan</source>
        <translation>Scan wird gelesen</translation>
    </message>
    <message>
        <source>rear bearing</source>
        <translation>hinteres Lager</translation>
    </message>
    <message>
        <source>rear of the column</source>
        <translation>Rückseite des Ständers</translation>
    </message>
    <message>
        <source>record of the source</source>
        <translation>Aufzeichnung der Quelle</translation>
    </message>
    <message>
        <source>recording ends at {:.3f} s</source>
        <translation>Aufzeichnung endet bei {:.3f} s</translation>
    </message>
    <message>
        <source>recording goes on after {:.3f} s</source>
        <translation>Aufzeichnung wird nach {:.3f} s fortgesetzt</translation>
    </message>
    <message>
        <source>reduction / %</source>
        <translation>Minderung / %</translation>
    </message>
    <message>
        <source>reduction of the rms (positive: smaller) against measurements spent after the setup (0: static)</source>
        <translation>Minderung des rms (positiv: kleiner) gegen verbrauchte Messungen nach der Anlernphase (0: statisch)</translation>
    </message>
    <message>
        <source>reference cycle: zero by definition</source>
        <translation>Referenzzyklus: definitionsgemäß null</translation>
    </message>
    <message>
        <source>reference record</source>
        <translation>Referenzaufzeichnung</translation>
    </message>
    <message>
        <source>refuses the connection; allowed: linuxcncrsh with the password of its option --connectpw</source>
        <translation>lehnt die Verbindung ab; zulässig: linuxcncrsh mit dem Passwort seiner Option --connectpw</translation>
    </message>
    <message>
        <source>region {},{} {} x {}</source>
        <translation>Bereich {},{} {} x {}</translation>
    </message>
    <message>
        <source>registering scans</source>
        <translation>Scans werden registriert</translation>
    </message>
    <message>
        <source>registers cannot be read afterwards.</source>
        <translation>Register lassen sich nicht nachträglich lesen.</translation>
    </message>
    <message>
        <source>relative error of the changes that {} reads</source>
        <translation>relativer Fehler der Änderungen, die {} anzeigt</translation>
    </message>
    <message>
        <source>relative to {}, for state {}</source>
        <translation>bezogen auf {}, für Zustand {}</translation>
    </message>
    <message>
        <source>replaying the campaign</source>
        <translation>Kampagne wird nachgespielt</translation>
    </message>
    <message>
        <source>rest for {}</source>
        <translation>{} Stillstand</translation>
    </message>
    <message>
        <source>resuming a batch</source>
        <translation>Batch-Auftrag wird fortgesetzt</translation>
    </message>
    <message>
        <source>retract_mm must not be smaller than clearance_mm.</source>
        <translation>retract_mm darf nicht kleiner als clearance_mm sein.</translation>
    </message>
    <message>
        <source>ridge regression on delayed inputs, forward selection</source>
        <translation>Ridge-Regression über verzögerte Eingänge, Vorwärtsauswahl</translation>
    </message>
    <message>
        <source>right side of the column</source>
        <translation>rechte Seite des Ständers</translation>
    </message>
    <message>
        <source>rms (reduction)</source>
        <translation>rms (Minderung)</translation>
    </message>
    <message>
        <source>role &quot;{}&quot; is not known; allowed: rotation, x_axis, y_axis or focus.</source>
        <translation>role „{}“ ist nicht bekannt; zulässig: rotation, x_axis, y_axis oder focus.</translation>
    </message>
    <message>
        <source>rotary drive</source>
        <translation>Drehantrieb</translation>
    </message>
    <message>
        <source>rotation of the frame about %1</source>
        <translation>Drehung des Gestells um %1</translation>
    </message>
    <message>
        <source>rotation of {}</source>
        <translation>Drehung von {}</translation>
    </message>
    <message>
        <source>rotation {}</source>
        <translation>Drehung {}</translation>
    </message>
    <message>
        <source>row number {} is not allowed; allowed: 1 to {} (rows of {}).</source>
        <translation>Zeilennummer {} ist nicht zulässig; zulässig: 1 bis {} (Zeilen von {}).</translation>
    </message>
    <message>
        <source>row tens upper left, row units upper right, column tens lower left, column units lower right; up = +Y (increasing row), so rows increase upwards when the pattern is seen from above</source>
        <translation>Zehner der Zeile oben links, Einer der Zeile oben rechts, Zehner der Spalte unten links, Einer der Spalte unten rechts; oben = +Y (steigende Zeile), Zeilen steigen also nach oben, wenn das Muster von oben gesehen wird</translation>
    </message>
    <message>
        <source>row {}</source>
        <translation>Zeile {}</translation>
    </message>
    <message>
        <source>rows of two numbers for every input</source>
        <translation>Zeilen mit zwei Zahlen je Eingang</translation>
    </message>
    <message>
        <source>rows outside {:.6g} to {:.6g} s, where the model was identified</source>
        <translation>Zeilen außerhalb {:.6g} bis {:.6g} s, wo das Modell identifiziert wurde</translation>
    </message>
    <message>
        <source>run the measuring cycle of {} as {}</source>
        <translation>Messzyklus von {} als {} ausführen</translation>
    </message>
    <message>
        <source>run {} for {}</source>
        <translation>{}, {} lang</translation>
    </message>
    <message>
        <source>running the simulation</source>
        <translation>die Simulation läuft</translation>
    </message>
    <message>
        <source>sag of the crossbeam</source>
        <translation>Durchhang des Querbalkens</translation>
    </message>
    <message>
        <source>said &quot;{}&quot;</source>
        <translation>meldete „{}“</translation>
    </message>
    <message>
        <source>scale of X</source>
        <translation>Maßstab von X</translation>
    </message>
    <message>
        <source>scale of Y</source>
        <translation>Maßstab von Y</translation>
    </message>
    <message>
        <source>scale of Z</source>
        <translation>Maßstab von Z</translation>
    </message>
    <message>
        <source>scale {}</source>
        <translation>Maßstab {}</translation>
    </message>
    <message>
        <source>scanning artefacts</source>
        <translation>Prüfkörper werden gescannt</translation>
    </message>
    <message>
        <source>screw bearing {}</source>
        <translation>Spindellagerung {}</translation>
    </message>
    <message>
        <source>screw {}</source>
        <translation>Kugelgewindetrieb {}</translation>
    </message>
    <message>
        <source>seed {}</source>
        <translation>Startwert {}</translation>
    </message>
    <message>
        <source>sends a line without an end</source>
        <translation>sendet eine Zeile ohne Ende</translation>
    </message>
    <message>
        <source>setting an interval</source>
        <translation>Intervall wird gesetzt</translation>
    </message>
    <message>
        <source>sharpness and odds of the choice between methods must be positive.</source>
        <translation>Schärfe und Chancenverhältnis der Verfahrenswahl müssen positiv sein.</translation>
    </message>
    <message>
        <source>shift along {}</source>
        <translation>Verschiebung entlang {}</translation>
    </message>
    <message>
        <source>thermal shock from coolant along %1</source>
        <translation>Temperaturschock durch Kühlschmierstoff entlang %1</translation>
    </message>
    <message>
        <source>shortening of the spindle by its speed along Z</source>
        <translation>drehzahlabhängige Verkürzung der Spindel entlang Z</translation>
    </message>
    <message>
        <source>sigma {} is not allowed; allowed: a standard uncertainty greater than zero, in {}.</source>
        <translation>sigma {} ist nicht zulässig; zulässig: eine Standardunsicherheit größer als null, in {}.</translation>
    </message>
    <message>
        <source>sigma {} is not allowed; allowed: greater than zero.</source>
        <translation>sigma {} ist nicht zulässig; zulässig: größer als null.</translation>
    </message>
    <message>
        <source>simulation with effects</source>
        <translation>Simulation mit Effekten</translation>
    </message>
    <message>
        <source>single value off by {} on {} ({}){}</source>
        <translation>Einzelwert um {} abweichend am {} ({}){}</translation>
    </message>
    <message>
        <source>slip of point %1 in its fixture</source>
        <translation>Rutschen des Punkts %1 in seiner Aufspannung</translation>
    </message>
    <message>
        <source>so far</source>
        <translation>bisher</translation>
    </message>
    <message>
        <source>software trigger</source>
        <translation>Software-Auslöser</translation>
    </message>
    <message>
        <source>some cycles leave parameters open</source>
        <translation>einige Zyklen lassen Parameter offen</translation>
    </message>
    <message>
        <source>speed in the control</source>
        <translation>Geschwindigkeit in der Steuerung</translation>
    </message>
    <message>
        <source>speeds out of order of time at {:g} s.</source>
        <translation>Drehzahlen nicht in zeitlicher Reihenfolge bei {:g} s.</translation>
    </message>
    <message>
        <source>spindle 0</source>
        <translation>Spindel 0</translation>
    </message>
    <message>
        <source>spindle at rest</source>
        <translation>Spindel im Stillstand</translation>
    </message>
    <message>
        <source>spindle bearing</source>
        <translation>Spindellager</translation>
    </message>
    <message>
        <source>spindle heat that depends on the position of %1</source>
        <translation>von der Position von %1 abhängige Spindelwärme</translation>
    </message>
    <message>
        <source>spindle housing</source>
        <translation>Spindelgehäuse</translation>
    </message>
    <message>
        <source>spindle turning</source>
        <translation>Spindel dreht</translation>
    </message>
    <message>
        <source>spindrift-simulator-run 1</source>
        <translation>spindrift-simulator-run 1</translation>
    </message>
    <message>
        <source>sslmode=verify-full</source>
        <translation>sslmode=verify-full</translation>
    </message>
    <message>
        <source>stands after the end of the program</source>
        <translation>steht nach dem Ende des Programms</translation>
    </message>
    <message>
        <source>starting a batch</source>
        <translation>Batch-Auftrag wird gestartet</translation>
    </message>
    <message>
        <source>state &quot;{}&quot; is not there; allowed: {}.</source>
        <translation>Zustand „{}“ ist nicht vorhanden; zulässig: {}.</translation>
    </message>
    <message>
        <source>state &quot;{}&quot; was not observed; allowed: {}.</source>
        <translation>Zustand „{}“ wurde nicht beobachtet; zulässig: {}.</translation>
    </message>
    <message>
        <source>state {}</source>
        <translation>Zustand {}</translation>
    </message>
    <message>
        <source>state {} has no displacement with a prediction; choose another state.</source>
        <translation>Zustand {} hat keine Verschiebung mit einer Vorhersage; einen anderen Zustand wählen.</translation>
    </message>
    <message>
        <source>state {} has {} deviations for {} fiducials; one for each is needed.</source>
        <translation>Zustand {} hat {} Abweichungen für {} Messmarken; für jede ist eine nötig.</translation>
    </message>
    <message>
        <source>states WIDTH {} times HEIGHT {} but POINTS {}.</source>
        <translation>gibt WIDTH {} mal HEIGHT {} an, aber POINTS {}.</translation>
    </message>
    <message>
        <source>states zero points.</source>
        <translation>gibt null Punkte an.</translation>
    </message>
    <message>
        <source>states {} and {} cannot be compared as sets of points; allowed: the same state twice.</source>
        <translation>die Zustände {} und {} lassen sich nicht als Punktsätze vergleichen; zulässig: zweimal derselbe Zustand.</translation>
    </message>
    <message>
        <source>states {} points of {} bytes, but the compressed block unpacks to {} bytes.</source>
        <translation>gibt {} Punkte zu {} Bytes an, aber der komprimierte Block ergibt {} Bytes.</translation>
    </message>
    <message>
        <source>static regression on all temperatures</source>
        <translation>statische Regression auf alle Temperaturen</translation>
    </message>
    <message>
        <source>step at {:.0f} s</source>
        <translation>Sprung bei {:.0f} s</translation>
    </message>
    <message>
        <source>step of {} between {} and {} ({}){}</source>
        <translation>Sprung von {} zwischen {} und {} ({}){}</translation>
    </message>
    <message>
        <source>stopped: the compensation fades</source>
        <translation>angehalten: die Kompensation klingt ab</translation>
    </message>
    <message>
        <source>stored observations</source>
        <translation>gespeicherte Beobachtungen</translation>
    </message>
    <message>
        <source>stylus &quot;{}&quot; is not in the machine file, so its radius is unknown; allowed: {}</source>
        <translation>Tastereinsatz „{}“ steht nicht in der Maschinendatei, sein Radius ist daher unbekannt; zulässig: {}</translation>
    </message>
    <message>
        <source>stylus &quot;{}&quot; is not in the machine file, so its radius is unknown; allowed: {}.</source>
        <translation>Tastereinsatz „{}“ steht nicht in der Maschinendatei, sein Radius ist daher unbekannt; zulässig: {}.</translation>
    </message>
    <message>
        <source>stylus &quot;{}&quot; is not in the machine file.</source>
        <translation>Tastereinsatz „{}“ steht nicht in der Maschinendatei.</translation>
    </message>
    <message>
        <source>stylus {} is within specification</source>
        <translation>Tastereinsatz {} liegt innerhalb der Spezifikation</translation>
    </message>
    <message>
        <source>stylus {} is loose or bent: it jumped by {:.1f} µm {} after {}, unlike thermal drift</source>
        <translation>Tastereinsatz {} ist locker oder verbogen: er sprang um {:.1f} µm {} nach {}, anders als bei thermischer Drift</translation>
    </message>
    <message>
        <source>stylus {} is loose or bent: the sphere&apos;s centre scatters by {:.1f} µm from pass to pass, unlike thermal drift</source>
        <translation>Tastereinsatz {} ist locker oder verbogen: das Kugelzentrum streut von Durchgang zu Durchgang um {:.1f} µm, anders als bei thermischer Drift</translation>
    </message>
    <message>
        <source>stylus {} is loose or bent: touches scatter by {:.1f} µm {}</source>
        <translation>Tastereinsatz {} ist locker oder verbogen: Antastungen streuen um {:.1f} µm {}</translation>
    </message>
    <message>
        <source>stylus {} leaves {:.3f} mm of room in the hole; allowed: 0.5 mm.</source>
        <translation>Tastereinsatz {} lässt {:.3f} mm Raum im Loch; zulässig: 0,5 mm.</translation>
    </message>
    <message>
        <source>stylus {} repeats to {:.2f} µm only; a healthy probe keeps {:.2f} µm</source>
        <translation>Tastereinsatz {} wiederholt sich nur auf {:.2f} µm; ein intakter Messtaster hält {:.2f} µm</translation>
    </message>
    <message>
        <source>stylus {} sees the sphere move by {:.1f} µm; {} passes do not distinguish a loose stylus from thermal drift: touch the sphere in more passes (five or more), or several times in one</source>
        <translation>Tastereinsatz {} sieht die Kugel um {:.1f} µm wandern; {} Durchgänge unterscheiden einen lockeren Tastereinsatz nicht von thermischer Drift: die Kugel in mehr Durchgängen antasten (fünf oder mehr) oder mehrmals in einem</translation>
    </message>
    <message>
        <source>sum of the effects {}</source>
        <translation>Summe der Effekte {}</translation>
    </message>
    <message>
        <source>switched off in the simulation; measured {}</source>
        <translation>in der Simulation abgeschaltet; gemessen {}</translation>
    </message>
    <message>
        <source>tables in a campaign with a log.csv, which tells how long they are</source>
        <translation>Tabellen in einer Kampagne mit log.csv, die angibt, wie lang sie sind</translation>
    </message>
    <message>
        <source>take again</source>
        <translation>wiederholen</translation>
    </message>
    <message>
        <source>taken as 0 in the simulation; measured {}</source>
        <translation>in der Simulation als 0 angenommen; gemessen {}</translation>
    </message>
    <message>
        <source>temperature unit &quot;{}&quot; is not known; allowed: degC, K, degF.</source>
        <translation>Temperatureinheit „{}“ ist nicht bekannt; zulässig: degC, K, degF.</translation>
    </message>
    <message>
        <source>test &quot;{}&quot; is not known; allowed: etve, spindle, axis.</source>
        <translation>Prüfung „{}“ ist nicht bekannt; zulässig: etve, spindle, axis.</translation>
    </message>
    <message>
        <source>test level {} is not allowed; allowed: between 0 and 1.</source>
        <translation>Testniveau {} ist nicht zulässig; zulässig: zwischen 0 und 1.</translation>
    </message>
    <message>
        <source>text &quot;{}&quot; follows a closing quote; allowed: a comma.</source>
        <translation>Text „{}“ folgt auf ein schließendes Anführungszeichen; zulässig: ein Komma.</translation>
    </message>
    <message>
        <source>that were measured in the reference state too</source>
        <translation>die auch im Referenzzustand gemessen wurden</translation>
    </message>
    <message>
        <source>The ARX fit was unstable: {}</source>
        <translation>Die ARX-Anpassung war instabil: {}</translation>
    </message>
    <message>
        <source>the JPEG quality must lie between 0 (none) and 100.</source>
        <translation>die JPEG-Qualität muss zwischen 0 (keine) und 100 liegen.</translation>
    </message>
    <message>
        <source>the axis test needs --observations with the readings at both ends.</source>
        <translation>die Achsprüfung braucht --observations mit den Messwerten an beiden Enden.</translation>
    </message>
    <message>
        <source>the bed b appears twice</source>
        <translation>das Bett b kommt zweimal vor</translation>
    </message>
    <message>
        <source>the bed b is missing</source>
        <translation>das Bett b fehlt</translation>
    </message>
    <message>
        <source>the byte 0x{:02X} is not UTF-8 (Latin-1, perhaps); allowed: CSV in UTF-8.</source>
        <translation>das Byte 0x{:02X} ist kein UTF-8 (vielleicht Latin-1); zulässig: CSV in UTF-8.</translation>
    </message>
    <message>
        <source>the camera&apos;s direction differs between sets</source>
        <translation>die Richtung der Kamera unterscheidet sich zwischen den Sätzen</translation>
    </message>
    <message>
        <source>The centre of rotation cannot be found: {}.</source>
        <translation>Das Drehzentrum ist nicht bestimmbar: {}.</translation>
    </message>
    <message>
        <source>The centre of rotation is not the same everywhere ({}): {} is used. The microscope has moved in the spindle or had not settled.</source>
        <translation>Das Drehzentrum ist nicht überall dasselbe ({}): verwendet wird {}. Das Mikroskop hat sich in der Spindel bewegt oder war nicht eingelaufen.</translation>
    </message>
    <message>
        <source>the change from state {} to {}</source>
        <translation>die Änderung von Zustand {} zu {}</translation>
    </message>
    <message>
        <source>the clock jumps back from {} to {}; allowed: a time that never decreases (cut the file at the jump, or correct the clock from here on).</source>
        <translation>die Uhr springt von {} auf {} zurück; zulässig: eine nie abnehmende Zeit (die Datei am Sprung teilen oder die Uhr ab hier berichtigen).</translation>
    </message>
    <message>
        <source>the compensation is at zero</source>
        <translation>die Kompensation ist null</translation>
    </message>
    <message>
        <source>the completed model needs at least one effect that was added; add one in the discrepancy.</source>
        <translation>das ergänzte Modell braucht mindestens einen hinzugefügten Effekt; in der Diskrepanz einen hinzufügen.</translation>
    </message>
    <message>
        <source>the contrast curves do not settle on a common shape</source>
        <translation>die Kontrastkurven ergeben keine gemeinsame Form</translation>
    </message>
    <message>
        <source>the contrast of {} has no maximum between its heights.</source>
        <translation>der Kontrast von {} hat zwischen den Höhen kein Maximum.</translation>
    </message>
    <message>
        <source>the control is back; the compensation returns from what is applied</source>
        <translation>die Steuerung ist wieder da; die Kompensation kehrt vom aufgeschalteten Wert aus zurück</translation>
    </message>
    <message>
        <source>the control is ready</source>
        <translation>die Steuerung ist bereit</translation>
    </message>
    <message>
        <source>the control was lost while the compensation faded; its watchdog continues the fade:</source>
        <translation>die Steuerung ging verloren, während die Kompensation abklang; ihre Überwachung führt das Abklingen fort:</translation>
    </message>
    <message>
        <source>the control was lost: {}</source>
        <translation>die Steuerung ging verloren: {}</translation>
    </message>
    <message>
        <source>the coolant alone</source>
        <translation>Kühlschmierstoff allein</translation>
    </message>
    <message>
        <source>the time histories differ: {:.3g} rms about a straight line</source>
        <translation>die Zeitverläufe unterscheiden sich: {:.3g} rms um eine Gerade</translation>
    </message>
    <message>
        <source>the covariance of the observations is not positive definite</source>
        <translation>die Kovarianz der Beobachtungen ist nicht positiv definit</translation>
    </message>
    <message>
        <source>the coverage factor must be positive.</source>
        <translation>der Erweiterungsfaktor muss positiv sein.</translation>
    </message>
    <message>
        <source>the cycle would send {} to {:.3f} mm ({}stylus {} at {}°); allowed: {} to {} mm.</source>
        <translation>der Zyklus würde {} auf {:.3f} mm fahren ({}Tastereinsatz {} bei {}°); zulässig: {} bis {} mm.</translation>
    </message>
    <message>
        <source>the deviations are {:.0f} times as large as the simulation predicts, with the same time history: one of them is not in µm (the simulation in mm, or the observations in nm); allowed: µm and µrad.</source>
        <translation>die Abweichungen sind {:.0f}-mal so groß, wie die Simulation vorhersagt, bei gleichem Zeitverlauf: eine von beiden ist nicht in µm (die Simulation in mm oder die Beobachtungen in nm); zulässig: µm und µrad.</translation>
    </message>
    <message>
        <source>the deviations are {:.0f} times smaller than the simulation predicts, with the same time history: one of them is not in µm (the observations in mm, or the simulation in nm); allowed: µm and µrad.</source>
        <translation>die Abweichungen sind {:.0f}-mal kleiner, als die Simulation vorhersagt, bei gleichem Zeitverlauf: eine von beiden ist nicht in µm (die Beobachtungen in mm oder die Simulation in nm); zulässig: µm und µrad.</translation>
    </message>
    <message>
        <source>the direction of approach is missing or zero; allowed: a unit vector in {nx}, {ny}, {nz}.</source>
        <translation>die Anfahrrichtung fehlt oder ist null; zulässig: ein Einheitsvektor in {nx}, {ny}, {nz}.</translation>
    </message>
    <message>
        <source>The direction of the camera differs between fiducials or states ({}): each fiducial is turned by its own axis images.</source>
        <translation>Die Richtung der Kamera unterscheidet sich zwischen Messmarken oder Zuständen ({}): jede Messmarke wird mit ihren eigenen Achsbildern gedreht.</translation>
    </message>
    <message>
        <source>the duration is not above zero.</source>
        <translation>die Dauer ist nicht über null.</translation>
    </message>
    <message>
        <source>the effects in the model</source>
        <translation>die Effekte im Modell</translation>
    </message>
    <message>
        <source>the end of the plan: the compensation fades</source>
        <translation>das Ende des Plans: die Kompensation klingt ab</translation>
    </message>
    <message>
        <source>the evaluation</source>
        <translation>die Auswertung</translation>
    </message>
    <message>
        <source>the event fits at {:.6g} s and at {:.6g} s alike; allowed: an event that does not repeat, or a smaller search range.</source>
        <translation>das Ereignis passt bei {:.6g} s ebenso wie bei {:.6g} s; zulässig: ein Ereignis, das sich nicht wiederholt, oder ein kleinerer Suchbereich.</translation>
    </message>
    <message>
        <source>the expansion coefficient</source>
        <translation>der Ausdehnungskoeffizient</translation>
    </message>
    <message>
        <source>the expected noise of a contrast must be greater than zero and its weight not negative.</source>
        <translation>das erwartete Rauschen eines Kontrasts muss größer als null und sein Gewicht nicht negativ sein.</translation>
    </message>
    <message>
        <source>the expected repeatability of the spindle must be greater than 0 µm and its weight not negative.</source>
        <translation>die erwartete Wiederholpräzision der Spindel muss größer als 0 µm und ihr Gewicht nicht negativ sein.</translation>
    </message>
    <message>
        <source>the field is empty; allowed: a name.</source>
        <translation>das Feld ist leer; zulässig: ein Name.</translation>
    </message>
    <message>
        <source>the file is empty; an image is needed (JPEG, PNG, TIFF, BMP or PGM).</source>
        <translation>die Datei ist leer; nötig ist ein Bild (JPEG, PNG, TIFF, BMP oder PGM).</translation>
    </message>
    <message>
        <source>the file is not there.</source>
        <translation>die Datei ist nicht vorhanden.</translation>
    </message>
    <message>
        <source>the fitted model</source>
        <translation>das angepasste Modell</translation>
    </message>
    <message>
        <source>the fitted model is unstable (a pole lies outside the unit circle): its free run grows without bound; use stabilised(), a longer period, a lower order or the output-error method.</source>
        <translation>das angepasste Modell ist instabil (ein Pol liegt außerhalb des Einheitskreises): sein freier Lauf wächst unbegrenzt; stabilised(), eine längere Periode, eine niedrigere Ordnung oder das Ausgangsfehler-Verfahren verwenden.</translation>
    </message>
    <message>
        <source>the fraction of the end value must lie between 0 and 1.</source>
        <translation>der Anteil des Endwerts muss zwischen 0 und 1 liegen.</translation>
    </message>
    <message>
        <source>the gain differs: the probe shows {:.0f} % of what the reference shows</source>
        <translation>die Verstärkung unterscheidet sich: der Messtaster zeigt {:.0f} % dessen, was die Referenz zeigt</translation>
    </message>
    <message>
        <source>The gain update made the largest errors worse: the ratio measured / simulated is meaningless where the simulation is near zero; use --update kalman, or bound the gain.</source>
        <translation>Die Verstärkungsnachführung verschlechterte die größten Abweichungen: das Verhältnis gemessen / simuliert ist sinnlos, wo die Simulation nahe null ist; --update kalman verwenden oder die Verstärkung begrenzen.</translation>
    </message>
    <message>
        <source>the gains and time constants of one way in which the signals in log.csv drive {}</source>
        <translation>die Verstärkungen und Zeitkonstanten einer Art, in der die Signale in log.csv {} antreiben</translation>
    </message>
    <message>
        <source>the gains could not be determined; give fewer inputs or a longer training range.</source>
        <translation>die Verstärkungen waren nicht bestimmbar; weniger Eingänge oder einen längeren Trainingsbereich angeben.</translation>
    </message>
    <message>
        <source>the height of a point does not depend on where the carriage stands</source>
        <translation>die Höhe eines Punkts hängt nicht davon ab, wo der Schlitten steht</translation>
    </message>
    <message>
        <source>the id of a fiducial of the machine</source>
        <translation>die Kennung einer Messmarke der Maschine</translation>
    </message>
    <message>
        <source>the id of a point of the machine</source>
        <translation>die Kennung eines Punkts der Maschine</translation>
    </message>
    <message>
        <source>the id of a surface of the machine</source>
        <translation>die Kennung einer Fläche der Maschine</translation>
    </message>
    <message>
        <source>the id of an artefact of the machine</source>
        <translation>die Kennung eines Prüfkörpers der Maschine</translation>
    </message>
    <message>
        <source>the id of an effect of the catalogue that this machine can have, or of the campaign&apos;s effects.json</source>
        <translation>die Kennung eines Effekts des Katalogs, den diese Maschine haben kann, oder aus effects.json der Kampagne</translation>
    </message>
    <message>
        <source>the id of another effect of this file{}</source>
        <translation>die Kennung eines anderen Effekts dieser Datei{}</translation>
    </message>
    <message>
        <source>the image has {:.0f} x {:.0f} pixels; at most 100 million pixels are allowed.</source>
        <translation>das Bild hat {:.0f} x {:.0f} Pixel; höchstens 100 Millionen Pixel sind zulässig.</translation>
    </message>
    <message>
        <source>the image has {} x {} pixels, the others {} x {}.</source>
        <translation>das Bild hat {} x {} Pixel, die anderen {} x {}.</translation>
    </message>
    <message>
        <source>the image is black: 99.5 % of its pixels are at or below level {:.0f} of 255</source>
        <translation>das Bild ist schwarz: 99,5 % seiner Pixel liegen bei oder unter Grauwert {:.0f} von 255</translation>
    </message>
    <message>
        <source>the image is blurred: its sharpest edges have a blur of about {:.0f} px, at most about 3 px can be decoded</source>
        <translation>das Bild ist unscharf: seine schärfste Kante hat eine Unschärfe von etwa {:.0f} px, decodierbar sind höchstens etwa 3 px</translation>
    </message>
    <message>
        <source>the image is damaged and cannot be read.</source>
        <translation>das Bild ist beschädigt und nicht lesbar.</translation>
    </message>
    <message>
        <source>the image is the same as {}.</source>
        <translation>das Bild ist dasselbe wie {}.</translation>
    </message>
    <message>
        <source>the image is white: 95 % of its pixels are at or above level {:.0f} of 255</source>
        <translation>das Bild ist weiß: 95 % seiner Pixel liegen bei oder über Grauwert {:.0f} von 255</translation>
    </message>
    <message>
        <source>the image shows no contrast: levels {:.0f} to {:.0f} with noise of {:.1f}</source>
        <translation>das Bild zeigt keinen Kontrast: Grauwerte {:.0f} bis {:.0f} mit Rauschen von {:.1f}</translation>
    </message>
    <message>
        <source>the images do not show different spindle orientations</source>
        <translation>die Bilder zeigen keine verschiedenen Spindelstellungen</translation>
    </message>
    <message>
        <source>the inputs of the model are {:.0f} s old; allowed: {:.0f} s</source>
        <translation>die Eingänge des Modells sind {:.0f} s alt; zulässig: {:.0f} s</translation>
    </message>
    <message>
        <source>redundant: the inputs kept for all outputs carry the same information; they leave {:.2g} % of the time history of the models with all inputs unexplained, with it {:.2g} %; {}</source>
        <translation>redundant: die für alle Ausgänge behaltenen Eingänge tragen dieselbe Information; sie lassen {:.2g} % des Zeitverlaufs der Modelle mit allen Eingängen unerklärt, mit ihm {:.2g} %; {}</translation>
    </message>
    <message>
        <source>the interval between thermal states must be positive (s).</source>
        <translation>das Intervall zwischen thermischen Zuständen muss positiv sein (s).</translation>
    </message>
    <message>
        <source>the interval of the on-machine measurements must be positive, in s.</source>
        <translation>das Intervall der Messungen auf der Maschine muss positiv sein, in s.</translation>
    </message>
    <message>
        <source>the iteration did not settle</source>
        <translation>die Iteration konvergierte nicht</translation>
    </message>
    <message>
        <source>the iteration did not converge; use fewer time constants or a longer range.</source>
        <translation>die Iteration konvergierte nicht; weniger Zeitkonstanten oder einen längeren Bereich verwenden.</translation>
    </message>
    <message>
        <source>redundant: the kept inputs carry the same information; they leave {:.2g} % of the time history of the model with all inputs unexplained, with it {:.2g} %; {}</source>
        <translation>redundant: die behaltenen Eingänge tragen dieselbe Information; sie lassen {:.2g} % des Zeitverlaufs des Modells mit allen Eingängen unerklärt, mit ihm {:.2g} %; {}</translation>
    </message>
    <message>
        <source>the largest change since the first cycle must be positive (µm).</source>
        <translation>die größte Änderung seit dem ersten Zyklus muss positiv sein (µm).</translation>
    </message>
    <message>
        <source>the largest distance from the nominal place must be positive (mm).</source>
        <translation>der größte Abstand von der Solllage muss positiv sein (mm).</translation>
    </message>
    <message>
        <source>the largest distance from the plane of the surface must be positive (µm).</source>
        <translation>der größte Abstand von der Ebene der Fläche muss positiv sein (µm).</translation>
    </message>
    <message>
        <source>the largest spread within a feature must be positive (µm).</source>
        <translation>die größte Streuung innerhalb eines Merkmals muss positiv sein (µm).</translation>
    </message>
    <message>
        <source>The limit of {} is below three measuring uncertainties ({:.3g}): noise alone will exceed it.</source>
        <translation>Die Grenze von {} liegt unter drei Messunsicherheiten ({:.3g}): schon das Rauschen wird sie überschreiten.</translation>
    </message>
    <message>
        <source>the line does not say artefact, feature and stylus; allowed: places in touch_line, or &quot;artefact&quot; and &quot;stylus&quot; in the template.</source>
        <translation>die Zeile nennt nicht Prüfkörper, Merkmal und Tastereinsatz; zulässig: Platzhalter in touch_line oder &quot;artefact&quot; und &quot;stylus&quot; in der Vorlage.</translation>
    </message>
    <message>
        <source>the line is wider than half a semi-axis; a thinner one is needed.</source>
        <translation>die Linie ist breiter als eine halbe Halbachse; eine dünnere ist nötig.</translation>
    </message>
    <message>
        <source>the list says</source>
        <translation>laut Liste</translation>
    </message>
    <message>
        <source>the log has no pos_x_mm, pos_y_mm or pos_z_mm, so no motion is seen in both; enter the offset.</source>
        <translation>das Protokoll hat weder pos_x_mm noch pos_y_mm noch pos_z_mm, es ist also keine Bewegung in beiden zu sehen; den Versatz eingeben.</translation>
    </message>
    <message>
        <source>the loop ends</source>
        <translation>der Regelkreis endet</translation>
    </message>
    <message>
        <source>the loop continues with {} measuring cycles and {} rows of the log</source>
        <translation>der Regelkreis wird mit {} Messzyklen und {} Zeilen des Protokolls fortgesetzt</translation>
    </message>
    <message>
        <source>the lower triangle of a square matrix of 1 + terms or 1 + 2 terms rows</source>
        <translation>das untere Dreieck einer quadratischen Matrix mit 1 + Terme oder 1 + 2 Terme Zeilen</translation>
    </message>
    <message>
        <source>the machine</source>
        <translation>die Maschine</translation>
    </message>
    <message>
        <source>The machine file gives no fixed bearing for {}; screw expansion is counted from 0 mm there, which shifts the spindle drift by the expansion times the distance to the real bearing.</source>
        <translation>Die Maschinendatei gibt kein Festlager für {} an; die Ausdehnung des Kugelgewindetriebs wird dort von 0 mm aus gezählt, was die Spindeldrift um Ausdehnung mal Abstand zum wahren Lager verschiebt.</translation>
    </message>
    <message>
        <source>the machine was homed anew: a measuring cycle has to look at its zero</source>
        <translation>die Maschine wurde neu referenziert: ein Messzyklus muss ihren Nullpunkt prüfen</translation>
    </message>
    <message>
        <source>the machine was homed anew: the compensation is off until a measuring cycle has looked at the zero</source>
        <translation>die Maschine wurde neu referenziert: die Kompensation ist aus, bis ein Messzyklus den Nullpunkt geprüft hat</translation>
    </message>
    <message>
        <source>the marks do not fix the place of the image: {}.</source>
        <translation>die Musterpunkte legen die Lage des Bildes nicht fest: {}.</translation>
    </message>
    <message>
        <source>the model gives a value that is not a number</source>
        <translation>das Modell liefert keine Zahl</translation>
    </message>
    <message>
        <source>the model has a double pole, so it has no equivalent in separate time constants.</source>
        <translation>das Modell hat einen doppelten Pol und daher keine Entsprechung in getrennten Zeitkonstanten.</translation>
    </message>
    <message>
        <source>the model has a pole that is not real and between 0 and 1, so it has no equivalent in first-order time constants; use the response or output-error method for a compensator.</source>
        <translation>das Modell hat einen Pol, der nicht reell zwischen 0 und 1 liegt, und daher keine Entsprechung in Zeitkonstanten erster Ordnung; für einen Kompensator das Verfahren response oder Ausgangsfehler verwenden.</translation>
    </message>
    <message>
        <source>the model has no time constants (an ARX model with complex poles); identify with --method response or oe.</source>
        <translation>das Modell hat keine Zeitkonstanten (ein ARX-Modell mit komplexen Polen); mit --method response oder oe identifizieren.</translation>
    </message>
    <message>
        <source>the model has no output {}; found: {}.</source>
        <translation>das Modell hat keinen Ausgang {}; gefunden: {}.</translation>
    </message>
    <message>
        <source>the model of {} is not written: it has no equivalent in first-order time constants (complex, negative or double poles), and a constant in its place would be run; use the method response or oe, or let the method be chosen.</source>
        <translation>das Modell von {} wird nicht geschrieben: es hat keine Entsprechung in Zeitkonstanten erster Ordnung (komplexe, negative oder doppelte Pole), und an seiner Stelle liefe eine Konstante; das Verfahren response oder oe verwenden oder das Verfahren wählen lassen.</translation>
    </message>
    <message>
        <source>The model of {} was called not good enough when it was identified ({}); do not use this compensation on a machine.</source>
        <translation>Das Modell von {} wurde bei der Identifikation als nicht gut genug beurteilt ({}); diese Kompensation nicht an einer Maschine verwenden.</translation>
    </message>
    <message>
        <source>the model over time</source>
        <translation>das Modell über der Zeit</translation>
    </message>
    <message>
        <source>the model was identified from {}, so no row of this log trained it</source>
        <translation>das Modell wurde aus {} identifiziert, keine Zeile dieses Protokolls trainierte es</translation>
    </message>
    <message>
        <source>the move goes through the artefact at X{:.2f} Y{:.2f} Z{:.2f}</source>
        <translation>die Bewegung geht bei X{:.2f} Y{:.2f} Z{:.2f} durch den Prüfkörper</translation>
    </message>
    <message>
        <source>the name of a column of log.csv, with a power such as &quot;spindle_rpm^1.5&quot;, or a list of such names</source>
        <translation>der Name einer Spalte von log.csv, mit einer Potenz wie &quot;spindle_rpm^1.5&quot;, oder eine Liste solcher Namen</translation>
    </message>
    <message>
        <source>the name of a parameter of this simulator</source>
        <translation>der Name eines Parameters dieses Simulators</translation>
    </message>
    <message>
        <source>the nine parameters</source>
        <translation>die neun Parameter</translation>
    </message>
    <message>
        <source>The nine parameters alone are improbable ({:.2g}), but there are too few points to check a model of {} on points it was not fitted to.</source>
        <translation>Die neun Parameter allein sind unwahrscheinlich ({:.2g}), aber es gibt zu wenige Punkte, um ein Modell von {} an nicht angepassten Punkten zu prüfen.</translation>
    </message>
    <message>
        <source>The nine parameters alone are improbable ({:.2g}), but {} does not predict points left out any better ({:.2f} µm against {:.2f} µm): single points are disturbed, or what is missing is of another kind.</source>
        <translation>Die neun Parameter allein sind unwahrscheinlich ({:.2g}), aber {} sagt ausgelassene Punkte nicht besser vorher ({:.2f} µm gegen {:.2f} µm): einzelne Punkte sind gestört, oder das Fehlende ist anderer Art.</translation>
    </message>
    <message>
        <source>The nine parameters are enough (probability {:.2g} among {} models).</source>
        <translation>Die neun Parameter genügen (Wahrscheinlichkeit {:.2g} unter {} Modellen).</translation>
    </message>
    <message>
        <source>the number of an input, from 0</source>
        <translation>die Nummer eines Eingangs, ab 0</translation>
    </message>
    <message>
        <source>the numbers run from {} to {}; first &lt;= last and two digits each (10 ... 99) are needed.</source>
        <translation>die Nummern laufen von {} bis {}; nötig ist erste &lt;= letzte und je zwei Stellen (10 ... 99).</translation>
    </message>
    <message>
        <source>the only input; its part of the prediction is {:.2g} rms</source>
        <translation>der einzige Eingang; sein Anteil an der Vorhersage ist {:.2g} rms</translation>
    </message>
    <message>
        <source>the operating log has no signal for &quot;{}&quot;, which the model needs.</source>
        <translation>das Betriebsprotokoll hat kein Signal für „{}“, das das Modell braucht.</translation>
    </message>
    <message>
        <source>the operator is asked which of the named effects are added</source>
        <translation>der Bediener wird gefragt, welche der benannten Effekte hinzugefügt werden</translation>
    </message>
    <message>
        <source>the options</source>
        <translation>die Optionen</translation>
    </message>
    <message>
        <source>the output is constant, there is nothing to model; allowed: an output that changes.</source>
        <translation>der Ausgang ist konstant, es gibt nichts zu modellieren; zulässig: ein Ausgang, der sich ändert.</translation>
    </message>
    <message>
        <source>the path of a number of {} in machine, programme, environment, physics or effects, such as &quot;physics.friction&quot; or &quot;effects.spindle.growth.z.size&quot;</source>
        <translation>der Pfad einer Zahl von {} in machine, programme, environment, physics oder effects, etwa &quot;physics.friction&quot; oder &quot;effects.spindle.growth.z.size&quot;</translation>
    </message>
    <message>
        <source>the pattern is seen from the side: half of its ellipses lie more than {:.1f} px beside where a look straight from above has them; lengths would be wrong</source>
        <translation>das Muster ist von der Seite gesehen: die Hälfte seiner Ellipsen liegt mehr als {:.1f} px neben der Lage bei senkrechter Sicht; Längen wären falsch</translation>
    </message>
    <message>
        <source>the pixel length must be greater than zero (µm).</source>
        <translation>die Pixelgröße muss größer als null sein (µm).</translation>
    </message>
    <message>
        <source>the pixel length of the virtual microscope must be greater than zero (µm).</source>
        <translation>die Pixelgröße des virtuellen Mikroskops muss größer als null sein (µm).</translation>
    </message>
    <message>
        <source>the plan of the session</source>
        <translation>der Plan der Sitzung</translation>
    </message>
    <message>
        <source>the plan says</source>
        <translation>laut Plan</translation>
    </message>
    <message>
        <source>the plant store can only be read here; nothing was stored.</source>
        <translation>die Werksdatenbank ist hier nur lesbar; nichts wurde gespeichert.</translation>
    </message>
    <message>
        <source>the plant store cannot be opened: {}.</source>
        <translation>die Werksdatenbank lässt sich nicht öffnen: {}.</translation>
    </message>
    <message>
        <source>the plant store cannot be reached: {}.</source>
        <translation>die Werksdatenbank ist nicht erreichbar: {}.</translation>
    </message>
    <message>
        <source>the plant store cannot be used: {}.</source>
        <translation>die Werksdatenbank lässt sich nicht verwenden: {}.</translation>
    </message>
    <message>
        <source>the plant store has been in use by others for a minute; try again.</source>
        <translation>die Werksdatenbank ist seit einer Minute von anderen belegt; erneut versuchen.</translation>
    </message>
    <message>
        <source>the plant store holds a value of another kind than its column.</source>
        <translation>die Werksdatenbank enthält einen Wert anderer Art als seine Spalte.</translation>
    </message>
    <message>
        <source>the plant store holds a value that is not JSON.</source>
        <translation>die Werksdatenbank enthält einen Wert, der kein JSON ist.</translation>
    </message>
    <message>
        <source>the points and components that were fitted do not determine {}; the other parameters hold</source>
        <translation>die angepassten Punkte und Komponenten bestimmen {} nicht; die anderen Parameter gelten</translation>
    </message>
    <message>
        <source>the points are not ordered: profiles cannot be distinguished</source>
        <translation>die Punkte sind ungeordnet: Profile sind nicht unterscheidbar</translation>
    </message>
    <message>
        <source>the points contradict a {} by {:.4f} mm and no single one of them is to blame</source>
        <translation>die Punkte widersprechen der Form {} um {:.4f} mm, ohne dass ein einzelner daran schuld ist</translation>
    </message>
    <message>
        <source>the points do not determine the line: no direction has more spread than the others</source>
        <translation>die Punkte bestimmen die Gerade nicht: keine Richtung hat mehr Ausdehnung als die anderen</translation>
    </message>
    <message>
        <source>The points do not determine the nine parameters, and so nothing of higher order.</source>
        <translation>Die Punkte bestimmen die neun Parameter nicht und daher nichts von höherer Ordnung.</translation>
    </message>
    <message>
        <source>the points do not determine the plane: they have no spread along {}</source>
        <translation>die Punkte bestimmen die Ebene nicht: sie haben keine Ausdehnung entlang {}</translation>
    </message>
    <message>
        <source>the points do not determine the {}: {}</source>
        <translation>die Punkte bestimmen {} nicht: {}</translation>
    </message>
    <message>
        <source>the positions do not determine all nine parameters: at least three that are not on one line are needed</source>
        <translation>die Positionen bestimmen nicht alle neun Parameter: nötig sind mindestens drei, die nicht auf einer Geraden liegen</translation>
    </message>
    <message>
        <source>the printed digits do not determine the gain: the sum of the denominator is {:.2g}, half a unit of its last digits is {:.2g}; gains from {:.3g} to {:.3g} round to the same print. Identify at a period suited to the time constants and keep all digits.</source>
        <translation>die gedruckten Stellen bestimmen die Verstärkung nicht: die Summe des Nenners ist {:.2g}, eine halbe Einheit seiner letzten Stellen {:.2g}; Verstärkungen von {:.3g} bis {:.3g} runden auf denselben Druck. Mit einer zu den Zeitkonstanten passenden Periode identifizieren und alle Stellen behalten.</translation>
    </message>
    <message>
        <source>the program ends with the probe not above the artefact</source>
        <translation>das Programm endet mit dem Messtaster nicht über dem Prüfkörper</translation>
    </message>
    <message>
        <source>the program has no end (M2 or M30)</source>
        <translation>das Programm hat kein Ende (M2 oder M30)</translation>
    </message>
    <message>
        <source>the program has no end (M30 or M2)</source>
        <translation>das Programm hat kein Ende (M30 oder M2)</translation>
    </message>
    <message>
        <source>the program of the log again</source>
        <translation>das Programm des Protokolls erneut</translation>
    </message>
    <message>
        <source>the program runs into its own alarm; allowed: M30 before it</source>
        <translation>das Programm läuft in seinen eigenen Alarm; zulässig: M30 davor</translation>
    </message>
    <message>
        <source>the program touches nothing</source>
        <translation>das Programm tastet nichts an</translation>
    </message>
    <message>
        <source>the program was ended at the control</source>
        <translation>das Programm wurde an der Steuerung beendet</translation>
    </message>
    <message>
        <source>the record begins with a running spindle: changes count from its first row, not from the cold machine.</source>
        <translation>die Aufzeichnung beginnt mit laufender Spindel: Änderungen zählen ab ihrer ersten Zeile, nicht ab der kalten Maschine.</translation>
    </message>
    <message>
        <source>the record ends before the setup of {:.6g} s is over; allowed: a longer record or a shorter setup.</source>
        <translation>die Aufzeichnung endet, bevor die Anlernphase von {:.6g} s vorüber ist; zulässig: eine längere Aufzeichnung oder eine kürzere Anlernphase.</translation>
    </message>
    <message>
        <source>the reference does not move: the gain cannot be compared</source>
        <translation>die Referenz bewegt sich nicht: die Verstärkung lässt sich nicht vergleichen</translation>
    </message>
    <message>
        <source>the reference moves too little to compare the gain</source>
        <translation>die Referenz bewegt sich zu wenig, um die Verstärkung zu vergleichen</translation>
    </message>
    <message>
        <source>the region of the table is empty; allowed: to greater than from, in mm.</source>
        <translation>der Bereich des Tisches ist leer; zulässig: „bis“ größer als „von“, in mm.</translation>
    </message>
    <message>
        <source>The residual of the ARX equation is not white (noise at the output, or missing dynamics): its coefficients are biased and their intervals do not hold; use --method oe or response.</source>
        <translation>Das Residuum der ARX-Gleichung ist nicht weiß (Rauschen am Ausgang oder fehlende Dynamik): ihre Koeffizienten sind verzerrt, ihre Intervalle gelten nicht; --method oe oder response verwenden.</translation>
    </message>
    <message>
        <source>The residuals are larger than the stated uncertainties allow (chi-squared {:.1f} with {} degrees of freedom, {}): the nine parameters do not describe this state, or a point is disturbed.</source>
        <translation>Die Residuen sind größer, als die angegebenen Unsicherheiten zulassen (Chi-Quadrat {:.1f} mit {} Freiheitsgraden, {}): die neun Parameter beschreiben diesen Zustand nicht, oder ein Punkt ist gestört.</translation>
    </message>
    <message>
        <source>the rest does not determine all parameters</source>
        <translation>die übrigen bestimmen nicht alle Parameter</translation>
    </message>
    <message>
        <source>the role here is {}, and {} needs {} {}; nothing was stored.</source>
        <translation>die Rolle hier ist {}, und {} braucht {} {}; nichts wurde gespeichert.</translation>
    </message>
    <message>
        <source>the second campaign</source>
        <translation>die zweite Kampagne</translation>
    </message>
    <message>
        <source>the semi-axes differ by less than 5 %; the direction of the ellipse could not be seen.</source>
        <translation>die Halbachsen unterscheiden sich um weniger als 5 %; die Richtung der Ellipse wäre nicht erkennbar.</translation>
    </message>
    <message>
        <source>the session&apos;s database cannot be used: {}.</source>
        <translation>die Datenbank der Sitzung lässt sich nicht verwenden: {}.</translation>
    </message>
    <message>
        <source>the session&apos;s database holds a key that is not a number.</source>
        <translation>die Datenbank der Sitzung enthält einen Schlüssel, der keine Zahl ist.</translation>
    </message>
    <message>
        <source>the session&apos;s database holds a key that is too large.</source>
        <translation>die Datenbank der Sitzung enthält einen zu großen Schlüssel.</translation>
    </message>
    <message>
        <source>the session&apos;s database holds a value of another kind than its column.</source>
        <translation>die Datenbank der Sitzung enthält einen Wert anderer Art als seine Spalte.</translation>
    </message>
    <message>
        <source>the session&apos;s database holds {} that is not JSON.</source>
        <translation>die Datenbank der Sitzung enthält {}, das kein JSON ist.</translation>
    </message>
    <message>
        <source>the session&apos;s database is damaged ({}); take it from a copy of the session. The captures in the folder campaigns are not touched by that.</source>
        <translation>die Datenbank der Sitzung ist beschädigt ({}); aus einer Kopie der Sitzung zurückholen. Die Aufnahmen im Ordner campaigns sind davon nicht betroffen.</translation>
    </message>
    <message>
        <source>the sets of points agree within their uncertainty</source>
        <translation>die Punktsätze stimmen innerhalb ihrer Unsicherheit überein</translation>
    </message>
    <message>
        <source>the sets of points disagree beyond their uncertainty</source>
        <translation>die Punktsätze unterscheiden sich über ihre Unsicherheit hinaus</translation>
    </message>
    <message>
        <source>the setup holds fewer than 20 measurements; allowed: a longer setup or a shorter interval.</source>
        <translation>die Anlernphase enthält weniger als 20 Messungen; zulässig: eine längere Anlernphase oder ein kürzeres Intervall.</translation>
    </message>
    <message>
        <source>the simulation gives no value for {} observations that it predicts with its own parameters.</source>
        <translation>die Simulation liefert keinen Wert für {} Beobachtungen, die sie mit ihren eigenen Parametern vorhersagt.</translation>
    </message>
    <message>
        <source>the simulation&apos;s parameter {}</source>
        <translation>der Parameter {} der Simulation</translation>
    </message>
    <message>
        <source>the size of a frame</source>
        <translation>die Größe eines Bildes</translation>
    </message>
    <message>
        <source>the spindle alone at {:g} rpm</source>
        <translation>die Spindel allein mit {:g} rpm</translation>
    </message>
    <message>
        <source>the spindle alone at {:g} rpm with {} at {:.0f} mm</source>
        <translation>die Spindel allein mit {:g} rpm mit {} bei {:.0f} mm</translation>
    </message>
    <message>
        <source>the spindle never runs in this record; allowed: a test with a speed above zero.</source>
        <translation>die Spindel läuft in dieser Aufzeichnung nie; zulässig: eine Prüfung mit einer Drehzahl über null.</translation>
    </message>
    <message>
        <source>the spindle turns ({:g} rpm at {:g} s), but an ETVE test is of a machine at rest; allowed: a log without a running spindle, or the test &quot;spindle&quot;.</source>
        <translation>die Spindel dreht ({:g} rpm bei {:g} s), aber eine ETVE-Prüfung gilt der ruhenden Maschine; zulässig: ein Protokoll ohne laufende Spindel oder die Prüfung &quot;spindle&quot;.</translation>
    </message>
    <message>
        <source>the spindle {} at {:g} s, but at {:g} rpm for most of its run: these are several steps of speed, not one test; allowed: a record of one step, or --range FROM:TO around it.</source>
        <translation>die Spindel {} bei {:g} s, aber die meiste Zeit mit {:g} rpm: das sind mehrere Drehzahlstufen, nicht eine Prüfung; zulässig: eine Aufzeichnung einer Stufe oder --range FROM:TO um sie herum.</translation>
    </message>
    <message>
        <source>the stable length has {} values for {} cycles; allowed: one per cycle.</source>
        <translation>die stabile Länge hat {} Werte für {} Zyklen; zulässig: einer je Zyklus.</translation>
    </message>
    <message>
        <source>the start of the log</source>
        <translation>der Beginn des Protokolls</translation>
    </message>
    <message>
        <source>the state of a filter does not fit; allowed: finite numbers, as many as it has unknowns.</source>
        <translation>der Zustand eines Filters passt nicht; zulässig: endliche Zahlen, so viele wie Unbekannte.</translation>
    </message>
    <message>
        <source>the stored discrepancy cannot be read ({}); search again.</source>
        <translation>die gespeicherte Diskrepanz ist nicht lesbar ({}); erneut suchen.</translation>
    </message>
    <message>
        <source>the stored discrepancy has a verdict that does not exist; search again.</source>
        <translation>die gespeicherte Diskrepanz hat ein Urteil, das es nicht gibt; erneut suchen.</translation>
    </message>
    <message>
        <source>the stored discrepancy is of an earlier version; search again.</source>
        <translation>die gespeicherte Diskrepanz stammt von einer früheren Version; erneut suchen.</translation>
    </message>
    <message>
        <source>the stored discrepancy is of another version; search again.</source>
        <translation>die gespeicherte Diskrepanz stammt von einer anderen Version; erneut suchen.</translation>
    </message>
    <message>
        <source>the stored discrepancy names a component that does not exist; search again.</source>
        <translation>die gespeicherte Diskrepanz nennt eine Komponente, die es nicht gibt; erneut suchen.</translation>
    </message>
    <message>
        <source>the stored search with the simulator cannot be read ({}); search again.</source>
        <translation>die gespeicherte Suche mit dem Simulator ist nicht lesbar ({}); erneut suchen.</translation>
    </message>
    <message>
        <source>the stored search with the simulator has a verdict that does not exist; search again.</source>
        <translation>die gespeicherte Suche mit dem Simulator hat ein Urteil, das es nicht gibt; erneut suchen.</translation>
    </message>
    <message>
        <source>the stored search with the simulator is of another version; search again.</source>
        <translation>die gespeicherte Suche mit dem Simulator stammt von einer anderen Version; erneut suchen.</translation>
    </message>
    <message>
        <source>the stored update of the simulation names a component that does not exist.</source>
        <translation>die gespeicherte Änderung der Simulation nennt eine Komponente, die es nicht gibt.</translation>
    </message>
    <message>
        <source>the styli leave the rotation about</source>
        <translation>die Tastereinsätze lassen die Drehung offen um</translation>
    </message>
    <message>
        <source>the surface differs from the reference {:.1f} times more than the noise explains: the artefact has changed its shape or the scan model does not fit.</source>
        <translation>die Fläche unterscheidet sich {:.1f}-mal mehr von der Referenz, als das Rauschen erklärt: der Prüfkörper hat seine Form geändert, oder das Scanmodell passt nicht.</translation>
    </message>
    <message>
        <source>the surface does not determine it.</source>
        <translation>die Fläche bestimmt sie nicht.</translation>
    </message>
    <message>
        <source>the surface leaves it free ({}).</source>
        <translation>die Fläche lässt sie frei ({}).</translation>
    </message>
    <message>
        <source>the table turns before the probe stands anywhere known</source>
        <translation>der Tisch dreht, bevor der Messtaster an einer bekannten Stelle steht</translation>
    </message>
    <message>
        <source>the table turns while the probe is not above the artefact</source>
        <translation>der Tisch dreht, während der Messtaster nicht über dem Prüfkörper ist</translation>
    </message>
    <message>
        <source>the temperature</source>
        <translation>die Temperatur</translation>
    </message>
    <message>
        <source>the test is shorter than 4 h: slow influences of the environment are not in it.</source>
        <translation>die Prüfung ist kürzer als 4 h: langsame Einflüsse der Umgebung sind nicht enthalten.</translation>
    </message>
    <message>
        <source>the test needs a log with displacements over time.</source>
        <translation>die Prüfung braucht ein Protokoll mit Verschiebungen über der Zeit.</translation>
    </message>
    <message>
        <source>the time constants {:.4g} s and {:.4g} s of input {} may be identical: their separate gains are not determined, only the whole response is; use one time constant fewer or a longer range.</source>
        <translation>die Zeitkonstanten {:.4g} s und {:.4g} s des Eingangs {} sind möglicherweise gleich: ihre einzelnen Verstärkungen sind nicht bestimmt, nur die gesamte Antwort; eine Zeitkonstante weniger oder einen längeren Bereich verwenden.</translation>
    </message>
    <message>
        <source>the time offset of {} has no number offset_s.</source>
        <translation>der Zeitversatz von {} hat keine Zahl offset_s.</translation>
    </message>
    <message>
        <source>the touch does not print which feature and stylus it belongs to</source>
        <translation>die Antastung druckt nicht, zu welchem Merkmal und Tastereinsatz sie gehört</translation>
    </message>
    <message>
        <source>the touch does not reach the artefact</source>
        <translation>die Antastung erreicht den Prüfkörper nicht</translation>
    </message>
    <message>
        <source>the touch is not measured in machine coordinates (REFERENCE SYSTEM:1)</source>
        <translation>die Antastung wird nicht in Maschinenkoordinaten gemessen (REFERENCE SYSTEM:1)</translation>
    </message>
    <message>
        <source>the touch may search {:.2f} mm behind the surface; allowed: {:.2f} mm</source>
        <translation>die Antastung darf {:.2f} mm hinter der Fläche suchen; zulässig: {:.2f} mm</translation>
    </message>
    <message>
        <source>the touch meets feature {} instead of {}</source>
        <translation>die Antastung trifft Merkmal {} statt {}</translation>
    </message>
    <message>
        <source>The touch noise rests on {:.0f} degrees of freedom only; the uncertainties are rough.</source>
        <translation>Das Antastrauschen beruht auf nur {:.0f} Freiheitsgraden; die Unsicherheiten sind grob.</translation>
    </message>
    <message>
        <source>the touch starts inside material</source>
        <translation>die Antastung beginnt im Material</translation>
    </message>
    <message>
        <source>the training range holds {} samples at a period of {:.6g} s; allowed: at least 60 (a longer range or a shorter --period).</source>
        <translation>der Trainingsbereich enthält {} Abtastwerte bei einer Periode von {:.6g} s; zulässig: mindestens 60 (ein längerer Bereich oder eine kürzere --period).</translation>
    </message>
    <message>
        <source>the training range holds {} samples of the output at a period of {:.6g} s; allowed: at least {} (a longer training range, or a shorter --period).</source>
        <translation>der Trainingsbereich enthält {} Abtastwerte des Ausgangs bei einer Periode von {:.6g} s; zulässig: mindestens {} (ein längerer Trainingsbereich oder eine kürzere --period).</translation>
    </message>
    <message>
        <source>the uncertainties of a measured position must be greater than 0 µm.</source>
        <translation>die Unsicherheiten einer gemessenen Position müssen größer als 0 µm sein.</translation>
    </message>
    <message>
        <source>the version of the program</source>
        <translation>die Version des Programms</translation>
    </message>
    <message>
        <source>the virtual camera needs between 16 and 20000 pixels in width and height.</source>
        <translation>die virtuelle Kamera braucht zwischen 16 und 20000 Pixel in Breite und Höhe.</translation>
    </message>
    <message>
        <source>the watchdog closed the channel: it is opened again from what is applied</source>
        <translation>die Überwachung schloss den Kanal: er wird vom aufgeschalteten Wert aus wieder geöffnet</translation>
    </message>
    <message>
        <source>the window</source>
        <translation>das Fenster</translation>
    </message>
    <message>
        <source>the window of the drift needs a part in (0, 1] and at least 3 measurements.</source>
        <translation>das Fenster der Drift braucht einen Anteil in (0, 1] und mindestens 3 Messungen.</translation>
    </message>
    <message>
        <source>the word {}{:g} is not allowed here</source>
        <translation>das Wort {}{:g} ist hier nicht zulässig</translation>
    </message>
    <message>
        <source>the work {} needs the option &quot;{}&quot;.</source>
        <translation>die Arbeit {} braucht die Option „{}“.</translation>
    </message>
    <message>
        <source>the zero has moved by X {:+.1f}, Y {:+.1f}, Z {:+.1f} µm: that is taken out of the reference and not compensated; look at the workpiece&apos;s zero</source>
        <translation>der Nullpunkt hat sich um X {:+.1f}, Y {:+.1f}, Z {:+.1f} µm verschoben: das wird aus der Referenz herausgenommen und nicht kompensiert; den Nullpunkt des Werkstücks prüfen</translation>
    </message>
    <message>
        <source>the zero is where it was: the compensation returns</source>
        <translation>der Nullpunkt ist, wo er war: die Kompensation kehrt zurück</translation>
    </message>
    <message>
        <source>the {} is cut short: it ends after {} bytes without its end marker; copy it again.</source>
        <translation>die Datei ({}) ist abgeschnitten: sie endet nach {} Bytes ohne Endmarke; erneut kopieren.</translation>
    </message>
    <message>
        <source>the {} shows no event, so no offset can be estimated; allowed: a record in which something moves.</source>
        <translation>{} zeigt kein Ereignis, der Versatz ist daher nicht schätzbar; zulässig: eine Aufzeichnung, in der sich etwas bewegt.</translation>
    </message>
    <message>
        <source>there are no touches; allowed: at least one.</source>
        <translation>es gibt keine Antastungen; zulässig: mindestens eine.</translation>
    </message>
    <message>
        <source>There are too few points to see anything of higher order than the nine parameters.</source>
        <translation>Es gibt zu wenige Punkte, um etwas von höherer Ordnung als die neun Parameter zu sehen.</translation>
    </message>
    <message>
        <source>there is no axis {}; the control drives X, Y and Z.</source>
        <translation>es gibt keine Achse {}; die Steuerung treibt X, Y und Z.</translation>
    </message>
    <message>
        <source>there is no program; allowed: at least one speed.</source>
        <translation>es gibt kein Programm; zulässig: mindestens eine Drehzahl.</translation>
    </message>
    <message>
        <source>there is no reading of E{}; allowed: readings of the axis at two positions.</source>
        <translation>es gibt keinen Messwert von E{}; zulässig: Messwerte der Achse an zwei Positionen.</translation>
    </message>
    <message>
        <source>there is no retract after a touch</source>
        <translation>nach einer Antastung fehlt der Rückzug</translation>
    </message>
    <message>
        <source>there is no retract after the last touch</source>
        <translation>nach der letzten Antastung fehlt der Rückzug</translation>
    </message>
    <message>
        <source>there is no set of images with the spindle turned</source>
        <translation>es gibt keinen Satz von Bildern mit gedrehter Spindel</translation>
    </message>
    <message>
        <source>there is no speed column (..._rpm); allowed: spindle_rpm.</source>
        <translation>es gibt keine Drehzahlspalte (..._rpm); zulässig: spindle_rpm.</translation>
    </message>
    <message>
        <source>there is no temperature, speed, feed or switch to choose inputs from; allowed: --inputs with the names of columns.</source>
        <translation>es gibt keine Temperatur, Drehzahl, keinen Vorschub oder Schalter als Eingang; zulässig: --inputs mit Spaltennamen.</translation>
    </message>
    <message>
        <source>there is no time column; allowed: time_s, time_min or time_h; found: {}.</source>
        <translation>es gibt keine Zeitspalte; zulässig: time_s, time_min oder time_h; gefunden: {}.</translation>
    </message>
    <message>
        <source>there is none</source>
        <translation>es gibt keine</translation>
    </message>
    <message>
        <source>there is not enough memory for the cloud</source>
        <translation>der Speicher reicht für die Punktwolke nicht aus</translation>
    </message>
    <message>
        <source>there is not enough memory for the image.</source>
        <translation>der Speicher reicht für das Bild nicht aus.</translation>
    </message>
    <message>
        <source>there is nothing to compensate with yet</source>
        <translation>es gibt noch nichts, womit kompensiert werden könnte</translation>
    </message>
    <message>
        <source>thermal expansion of the %1 ball screw</source>
        <translation>thermische Ausdehnung des Kugelgewindetriebs %1</translation>
    </message>
    <message>
        <source>they disagree by {:.0f} µm</source>
        <translation>sie weichen um {:.0f} µm voneinander ab</translation>
    </message>
    <message>
        <source>this is another pattern: its ellipses carry rows {} to {} and columns {} to {}, the expected one has rows {} to {} and columns {} to {}</source>
        <translation>dies ist ein anderes Muster: seine Ellipsen tragen Zeilen {} bis {} und Spalten {} bis {}, das erwartete hat Zeilen {} bis {} und Spalten {} bis {}</translation>
    </message>
    <message>
        <source>this is not an image that can be read (JPEG, PNG, TIFF, BMP or PGM are).</source>
        <translation>dies ist kein lesbares Bild (lesbar: JPEG, PNG, TIFF, BMP oder PGM).</translation>
    </message>
    <message>
        <source>this model</source>
        <translation>dieses Modell</translation>
    </message>
    <message>
        <source>this role may not do that in the plant store ({}); ask its owner for the role of a writer.</source>
        <translation>diese Rolle darf das in der Werksdatenbank nicht ({}); deren Eigentümer um die Rolle mit Schreibrecht bitten.</translation>
    </message>
    <message>
        <source>this user may not make namespaces of network, shared memory, mounts and processes (unshare)</source>
        <translation>dieser Benutzer darf keine Namensräume für Netzwerk, gemeinsamen Speicher, Einhängepunkte und Prozesse anlegen (unshare)</translation>
    </message>
    <message>
        <source>tilt of the head about %1</source>
        <translation>Neigung des Spindelkopfs um %1</translation>
    </message>
    <message>
        <source>time / h</source>
        <translation>Zeit / h</translation>
    </message>
    <message>
        <source>time by which {} follows late</source>
        <translation>Zeit, um die {} nacheilt</translation>
    </message>
    <message>
        <source>time constants or inputs cannot be distinguished with these data; use fewer time constants or inputs.</source>
        <translation>Zeitkonstanten oder Eingänge sind mit diesen Daten nicht trennbar; weniger Zeitkonstanten oder Eingänge verwenden.</translation>
    </message>
    <message>
        <source>time of artefact {} runs backwards from {} s to {} s; allowed: touches of an artefact in order of time.</source>
        <translation>die Zeit des Prüfkörpers {} läuft von {} s auf {} s zurück; zulässig: Antastungen eines Prüfkörpers in zeitlicher Reihenfolge.</translation>
    </message>
    <message>
        <source>time of fiducial {} runs backwards from {} s to {} s; allowed: rows of a fiducial in order of time.</source>
        <translation>die Zeit der Messmarke {} läuft von {} s auf {} s zurück; zulässig: Zeilen einer Messmarke in zeitlicher Reihenfolge.</translation>
    </message>
    <message>
        <source>time of point {} runs backwards from {} s to {} s; allowed: rows of a point in order of time.</source>
        <translation>die Zeit des Punkts {} läuft von {} s auf {} s zurück; zulässig: Zeilen eines Punkts in zeitlicher Reihenfolge.</translation>
    </message>
    <message>
        <source>time of {} runs backwards from {} s to {} s; allowed: rows of a point in order of time.</source>
        <translation>die Zeit von {} läuft von {} s auf {} s zurück; zulässig: Zeilen eines Punkts in zeitlicher Reihenfolge.</translation>
    </message>
    <message>
        <source>time runs backwards from {} s to {} s; allowed: rows in order of time.</source>
        <translation>die Zeit läuft von {} s auf {} s zurück; zulässig: Zeilen in zeitlicher Reihenfolge.</translation>
    </message>
    <message>
        <source>time since {}</source>
        <translation>Zeit seit {}</translation>
    </message>
    <message>
        <source>duplicate time {} s of artefact {}; allowed: one touch at a time.</source>
        <translation>doppelte Zeit {} s des Prüfkörpers {}; zulässig: eine Antastung zur gleichen Zeit.</translation>
    </message>
    <message>
        <source>time {} s of {} of point {} follows {} s; allowed: rising times for each parameter, point and component.</source>
        <translation>Zeit {} s von {} des Punkts {} folgt auf {} s; zulässig: steigende Zeiten je Parameter, Punkt und Komponente.</translation>
    </message>
    <message>
        <source>times in order, from 0</source>
        <translation>Zeiten in Reihenfolge, ab 0</translation>
    </message>
    <message>
        <source>together with another it looks like {}, whose driver the log lacks</source>
        <translation>zusammen mit einem anderen sieht er aus wie {}, dessen Antriebsgröße im Protokoll fehlt</translation>
    </message>
    <message>
        <source>too few observations to decide</source>
        <translation>zu wenige Beobachtungen für eine Entscheidung</translation>
    </message>
    <message>
        <source>too few samples</source>
        <translation>zu wenige Abtastwerte</translation>
    </message>
    <message>
        <source>Too few samples for a choice between methods: response.</source>
        <translation>Zu wenige Abtastwerte für eine Verfahrenswahl: response.</translation>
    </message>
    <message>
        <source>too few samples for a regression</source>
        <translation>zu wenige Abtastwerte für eine Regression</translation>
    </message>
    <message>
        <source>took longer than {} s</source>
        <translation>dauerte länger als {} s</translation>
    </message>
    <message>
        <source>tool {} is back in the spindle: measuring cycles go on</source>
        <translation>Werkzeug {} ist wieder in der Spindel: die Messzyklen gehen weiter</translation>
    </message>
    <message>
        <source>tool {} is in the spindle: the compensation continues, measuring cycles wait for tool {}</source>
        <translation>Werkzeug {} ist in der Spindel: die Kompensation läuft weiter, Messzyklen warten auf Werkzeug {}</translation>
    </message>
    <message>
        <source>touch number {} is not allowed; allowed: 0, 1, 2, ...</source>
        <translation>Antastnummer {} ist nicht zulässig; zulässig: 0, 1, 2, ...</translation>
    </message>
    <message>
        <source>touch {} of {} is there already; the first one is kept</source>
        <translation>Antastung {} von {} ist schon vorhanden; die erste wird behalten</translation>
    </message>
    <message>
        <source>duplicate touch {} of {} with stylus {} at {}° in cycle {}; allowed: every touch of a cycle once.</source>
        <translation>doppelte Antastung {} von {} mit Tastereinsatz {} bei {}° in Zyklus {}; zulässig: jede Antastung eines Zyklus einmal.</translation>
    </message>
    <message>
        <source>touch {} {} does not run along its axis.</source>
        <translation>Antastung {} {} läuft nicht entlang ihrer Achse.</translation>
    </message>
    <message>
        <source>Train and test overlap: the test figures are not evidence for new data.</source>
        <translation>Trainings- und Prüfbereich überlappen: die Prüfzahlen sind kein Beleg für neue Daten.</translation>
    </message>
    <message>
        <source>trigger {}</source>
        <translation>Auslöser {}</translation>
    </message>
    <message>
        <source>true or false</source>
        <translation>true oder false</translation>
    </message>
    <message>
        <source>rotation about {} through ({:.1f}, {:.1f}, {:.1f}) mm</source>
        <translation>Drehung um {} durch ({:.1f}, {:.1f}, {:.1f}) mm</translation>
    </message>
    <message>
        <source>turned by 180 degrees about Z</source>
        <translation>um 180 Grad um Z gedreht</translation>
    </message>
    <message>
        <source>turns at {:g} rpm</source>
        <translation>dreht mit {:g} rpm</translation>
    </message>
    <message>
        <source>two bounds in s, not negative and the smaller first, such as [60, 20000]</source>
        <translation>zwei Grenzen in s, nicht negativ und die kleinere zuerst, etwa [60, 20000]</translation>
    </message>
    <message>
        <source>two bounds in s, the smaller first, such as [60, 20000]</source>
        <translation>zwei Grenzen in s, die kleinere zuerst, etwa [60, 20000]</translation>
    </message>
    <message>
        <source>two names of parameters, begin and end</source>
        <translation>zwei Namen von Parametern, Beginn und Ende</translation>
    </message>
    <message>
        <source>two numbers</source>
        <translation>zwei Zahlen</translation>
    </message>
    <message>
        <source>two numbers for every input</source>
        <translation>zwei Zahlen je Eingang</translation>
    </message>
    <message>
        <source>two numbers in ascending order</source>
        <translation>zwei Zahlen in aufsteigender Folge</translation>
    </message>
    <message>
        <source>two numbers x, y</source>
        <translation>zwei Zahlen x, y</translation>
    </message>
    <message>
        <source>two numbers x, y (and z): spindle minus column</source>
        <translation>zwei Zahlen x, y (und z): Spindel minus Ständer</translation>
    </message>
    <message>
        <source>two numbers, from and to</source>
        <translation>zwei Zahlen, von und bis</translation>
    </message>
    <message>
        <source>two numbers, the smaller first</source>
        <translation>zwei Zahlen, die kleinere zuerst</translation>
    </message>
    <message>
        <source>two numbers: an angle within 0.5 rad and its standard uncertainty above 0</source>
        <translation>zwei Zahlen: ein Winkel innerhalb 0,5 rad und seine Standardunsicherheit über 0</translation>
    </message>
    <message>
        <source>two patterns are in view, so that it is not known which one is meant</source>
        <translation>zwei Muster sind im Bild, daher ist nicht bekannt, welches gemeint ist</translation>
    </message>
    <message>
        <source>two whole numbers, the first and the last seed</source>
        <translation>zwei ganze Zahlen, erster und letzter Startwert</translation>
    </message>
    <message>
        <source>uncertainty of {} is {:.2f}</source>
        <translation>Unsicherheit von {} ist {:.2f}</translation>
    </message>
    <message>
        <source>non-uniform expansion of the %1 ball screw</source>
        <translation>ungleichmäßige Ausdehnung des Kugelgewindetriebs %1</translation>
    </message>
    <message>
        <source>unknown process</source>
        <translation>unbekannter Prozess</translation>
    </message>
    <message>
        <source>unstable poles were drawn to |z| = {}; judge it in free run before use.</source>
        <translation>instabile Pole wurden auf |z| = {} gezogen; vor der Verwendung im freien Lauf beurteilen.</translation>
    </message>
    <message>
        <source>upside down (mirrored in z)</source>
        <translation>auf dem Kopf (in z gespiegelt)</translation>
    </message>
    <message>
        <source>use &quot;{}&quot; is not known; allowed: fit, holdout or exclude.</source>
        <translation>use „{}“ ist nicht bekannt; zulässig: fit, holdout oder exclude.</translation>
    </message>
    <message>
        <source>vertical machining centre</source>
        <translation>vertikales Bearbeitungszentrum</translation>
    </message>
    <message>
        <source>virtual crossbeam</source>
        <translation>virtueller Querbalken</translation>
    </message>
    <message>
        <source>virtual fiducials</source>
        <translation>virtuelle Messmarken</translation>
    </message>
    <message>
        <source>virtual three-axis gantry</source>
        <translation>virtuelle dreiachsige Portalmaschine</translation>
    </message>
    <message>
        <source>virtual three-axis mill</source>
        <translation>virtuelle dreiachsige Fräsmaschine</translation>
    </message>
    <message>
        <source>waiting for the plant store</source>
        <translation>Warten auf die Werksdatenbank</translation>
    </message>
    <message>
        <source>waits for the first wish</source>
        <translation>wartet auf den ersten Sollwert</translation>
    </message>
    <message>
        <source>warm at the start</source>
        <translation>zu Beginn warm</translation>
    </message>
    <message>
        <source>warm-up of the instrument along %1</source>
        <translation>Warmlauf des Messgeräts entlang %1</translation>
    </message>
    <message>
        <source>was added</source>
        <translation>wurde hinzugefügt</translation>
    </message>
    <message>
        <source>was ended by signal {}{}</source>
        <translation>wurde durch Signal {} beendet{}</translation>
    </message>
    <message>
        <source>was not done after {:.6g} s (&quot;time_limit_s&quot;){}</source>
        <translation>war nach {:.6g} s nicht fertig (&quot;time_limit_s&quot;){}</translation>
    </message>
    <message>
        <source>watchdog reaches the channel</source>
        <translation>Überwachung (Watchdog) erreicht den Kanal</translation>
    </message>
    <message>
        <source>weighing effects</source>
        <translation>Effekte werden abgewogen</translation>
    </message>
    <message>
        <source>were added</source>
        <translation>wurden hinzugefügt</translation>
    </message>
    <message>
        <source>what it leaves is too large beside it ({:.2f}), or noise would do ({:.0f}): it may imitate a cause outside the catalogue</source>
        <translation>was er übrig lässt, ist neben ihm zu groß ({:.2f}), oder Rauschen würde genügen ({:.0f}): er ahmt möglicherweise eine Ursache außerhalb des Katalogs nach</translation>
    </message>
    <message>
        <source>what it was made from is not known</source>
        <translation>woraus es entstand, ist nicht bekannt</translation>
    </message>
    <message>
        <source>what it was made from is not known to this version</source>
        <translation>woraus es entstand, ist dieser Version nicht bekannt</translation>
    </message>
    <message>
        <source>what the control held meanwhile is not repeated.</source>
        <translation>was die Steuerung inzwischen enthielt, wird nicht wiederholt.</translation>
    </message>
    <message>
        <source>what was named could not be fitted</source>
        <translation>das Benannte war nicht anpassbar</translation>
    </message>
    <message>
        <source>what {} would explain, but cannot be named{}</source>
        <translation>was {} erklären würde, aber nicht benannt werden kann{}</translation>
    </message>
    <message>
        <source>if updates stop, the control holds the compensation</source>
        <translation>wenn keine Aktualisierungen mehr kommen, hält die Steuerung die Kompensation</translation>
    </message>
    <message>
        <source>if updates stop, the control lets the compensation fade</source>
        <translation>wenn keine Aktualisierungen mehr kommen, lässt die Steuerung die Kompensation abklingen</translation>
    </message>
    <message>
        <source>with a period of about {:.0f} s</source>
        <translation>mit einer Periode von etwa {:.0f} s</translation>
    </message>
    <message>
        <source>with it the held-out states are predicted worse ({:.2f} µm rms, without it {:.2f})</source>
        <translation>mit ihm werden die Validierungsdaten schlechter vorhergesagt ({:.2f} µm rms, ohne ihn {:.2f})</translation>
    </message>
    <message>
        <source>with updates</source>
        <translation>mit Nachführung</translation>
    </message>
    <message>
        <source>with {} = {} the simulation gives no value for {} observations that it predicts with its own parameters.</source>
        <translation>mit {} = {} liefert die Simulation keinen Wert für {} Beobachtungen, die sie mit ihren eigenen Parametern vorhersagt.</translation>
    </message>
    <message>
        <source>within</source>
        <translation>innerhalb von</translation>
    </message>
    <message>
        <source>without data</source>
        <translation>ohne Daten</translation>
    </message>
    <message>
        <source>without the effects that cannot be named it breaks its sign or its bounds</source>
        <translation>ohne die nicht benennbaren Effekte verletzt er sein Vorzeichen oder seine Grenzen</translation>
    </message>
    <message>
        <source>without update</source>
        <translation>ohne Nachführung</translation>
    </message>
    <message>
        <source>working on a batch</source>
        <translation>Batch-Auftrag wird bearbeitet</translation>
    </message>
    <message>
        <source>writing the tables</source>
        <translation>Tabellen werden geschrieben</translation>
    </message>
    <message>
        <source>zero or a number above, in</source>
        <translation>null oder eine größere Zahl, in</translation>
    </message>
    <message>
        <source>{:.0f} % of the pixels are overexposed: reduce the illumination.</source>
        <translation>{:.0f} % der Pixel sind überbelichtet: Beleuchtung verringern.</translation>
    </message>
    <message>
        <source>{:.0f} % of the readings of {} lie more than {:.0f} times as far off as the others: too many to be down-weighted; check how they were taken before you rely on a named effect.</source>
        <translation>{:.0f} % der Messwerte von {} liegen mehr als {:.0f}-mal so weit entfernt wie die übrigen: zu viele, um sie geringer zu gewichten; ihre Entstehung prüfen, bevor man sich auf einen benannten Effekt verlässt.</translation>
    </message>
    <message>
        <source>{:.0f} % of the surface does not agree with the reference (something lay in the way?) and was left out.</source>
        <translation>{:.0f} % der Fläche stimmen nicht mit der Referenz überein (lag etwas im Weg?) und wurden ausgelassen.</translation>
    </message>
    <message>
        <source>{:.0f} min</source>
        <translation>{:.0f} min</translation>
    </message>
    <message>
        <source>{:.2f} to {:.2f} h, {}: true rms at the tool point</source>
        <translation>{:.2f} bis {:.2f} h, {}: wahrer rms am Werkzeugpunkt</translation>
    </message>
    <message>
        <source>{:.2f} {} in {} at {}, {:.0f} s</source>
        <translation>{:.2f} {} in {} bei {}, {:.0f} s</translation>
    </message>
    <message>
        <source>{:.3f} before, {:.3f} after over all rows, </source>
        <translation>{:.3f} vorher, {:.3f} nachher über alle Zeilen, </translation>
    </message>
    <message>
        <source>{:g} h of machine time; allowed: 0.5 to 48 h.</source>
        <translation>{:g} h Maschinenzeit; zulässig: 0,5 bis 48 h.</translation>
    </message>
    <message>
        <source>{:g} rpm is beyond the spindle&apos;s limit, {:g} rpm</source>
        <translation>{:g} rpm überschreitet die Grenze der Spindel, {:g} rpm</translation>
    </message>
    <message>
        <source>{:g} s of silence; allowed: up to {:g} s</source>
        <translation>{:g} s Stille; zulässig: bis {:g} s</translation>
    </message>
    <message>
        <source>{:g} to {:g}</source>
        <translation>{:g} bis {:g}</translation>
    </message>
    <message>
        <source>{{{{{}}}}} is not an expression; allowed: one value from {} with the functions of muParser.</source>
        <translation>{{{{{}}}}} ist kein Ausdruck; zulässig: ein Wert aus {} mit den Funktionen von muParser.</translation>
    </message>
    <message>
        <source>{{{{{}}}}} names &quot;{}&quot;, which is not a parameter of simulator.json; allowed: {}.</source>
        <translation>{{{{{}}}}} nennt „{}“, das kein Parameter von simulator.json ist; zulässig: {}.</translation>
    </message>
    <message>
        <source>{{{{{}}}}} names no table of simulator.json; allowed: {}.</source>
        <translation>{{{{{}}}}} nennt keine Tabelle von simulator.json; zulässig: {}.</translation>
    </message>
    <message>
        <source>{} (time constant {:.0f} s on, {:.0f} s off)</source>
        <translation>{} (Zeitkonstante {:.0f} s an, {:.0f} s aus)</translation>
    </message>
    <message>
        <source>{} (time constant {:.0f} s)</source>
        <translation>{} (Zeitkonstante {:.0f} s)</translation>
    </message>
    <message>
        <source>{} (the simulation&apos;s parameter {})</source>
        <translation>{} (der Parameter {} der Simulation)</translation>
    </message>
    <message>
        <source>{} &quot;{}&quot; is not a range; allowed: FROM:TO in seconds with FROM &lt; TO, such as 0:57600.</source>
        <translation>{} „{}“ ist kein Bereich; zulässig: FROM:TO in Sekunden mit FROM &lt; TO, etwa 0:57600.</translation>
    </message>
    <message>
        <source>{} after the start</source>
        <translation>{} nach dem Beginn</translation>
    </message>
    <message>
        <source>{} alone at {:g} m/min</source>
        <translation>{} allein mit {:g} m/min</translation>
    </message>
    <message>
        <source>{} and {} cannot be distinguished with these data (correlation {:.3f}): only their joint effect is determined.</source>
        <translation>{} und {} sind mit diesen Daten nicht trennbar (Korrelation {:.3f}): nur ihre gemeinsame Wirkung ist bestimmt.</translation>
    </message>
    <message>
        <source>{} and {} have the same effect on the observations: their magnitudes cannot be estimated jointly; allowed: one of the two.</source>
        <translation>{} und {} wirken gleich auf die Beobachtungen: ihre Größen sind gemeinsam nicht schätzbar; zulässig: einer von beiden.</translation>
    </message>
    <message>
        <source>{} and {} have the same shape at all points and the same drivers: no measurement of this kind can distinguish them.</source>
        <translation>{} und {} haben an allen Punkten dieselbe Form und dieselben Antriebsgrößen: keine Messung dieser Art kann sie unterscheiden.</translation>
    </message>
    <message>
        <source>{} and {} of the simulation have the same effect on the observations and cannot be distinguished.</source>
        <translation>{} und {} der Simulation wirken gleich auf die Beobachtungen und sind nicht unterscheidbar.</translation>
    </message>
    <message>
        <source>{} are at points that {} lacks ({})</source>
        <translation>{} liegen an Punkten, die {} fehlen ({})</translation>
    </message>
    <message>
        <source>{} are of components that {} lacks ({})</source>
        <translation>{} sind von Komponenten, die {} fehlen ({})</translation>
    </message>
    <message>
        <source>{} at {}</source>
        <translation>{} bei {}</translation>
    </message>
    <message>
        <source>{} begins in {}: {}.</source>
        <translation>{} beginnt in {}: {}.</translation>
    </message>
    <message>
        <source>{} belongs to a loop that has reached its end; allowed: a new or empty folder.</source>
        <translation>{} gehört zu einem beendeten Regelkreis; zulässig: ein neuer oder leerer Ordner.</translation>
    </message>
    <message>
        <source>{} belongs to a loop with another plan (machine, touches, temperatures or simulation); allowed: the plan it was begun with, or a new folder.</source>
        <translation>{} gehört zu einem Regelkreis mit anderem Plan (Maschine, Antastungen, Temperaturen oder Simulation); zulässig: der Plan, mit dem er begonnen wurde, oder ein neuer Ordner.</translation>
    </message>
    <message>
        <source>{} between {} points</source>
        <translation>{} zwischen {} Punkten</translation>
    </message>
    <message>
        <source>{} by {:.1f} K</source>
        <translation>{} um {:.1f} K</translation>
    </message>
    <message>
        <source>{} cannot be accepted: nothing in the log drives it, or these data do not show it.</source>
        <translation>{} kann nicht angenommen werden: nichts im Protokoll treibt ihn an, oder diese Daten zeigen ihn nicht.</translation>
    </message>
    <message>
        <source>{} cannot be connected: {}.</source>
        <translation>{} lässt sich nicht verbinden: {}.</translation>
    </message>
    <message>
        <source>{} cannot be fitted: its bounds &quot;min&quot; and &quot;max&quot; are both {}.</source>
        <translation>{} kann nicht angepasst werden: seine Grenzen &quot;min&quot; und &quot;max&quot; sind beide {}.</translation>
    </message>
    <message>
        <source>{} cannot be mapped: {}.</source>
        <translation>{} lässt sich nicht als Karte darstellen: {}.</translation>
    </message>
    <message>
        <source>{} cannot be opened as a serial line: {}.</source>
        <translation>{} lässt sich nicht als serielle Leitung öffnen: {}.</translation>
    </message>
    <message>
        <source>{} cannot be put aside: {}.</source>
        <translation>{} lässt sich nicht beiseitelegen: {}.</translation>
    </message>
    <message>
        <source>{} cannot be read: {}. Capturing continues when the folder is available again.</source>
        <translation>{} ist nicht lesbar: {}. Die Aufnahme geht weiter, sobald der Ordner wieder verfügbar ist.</translation>
    </message>
    <message>
        <source>{} cannot be run: {}</source>
        <translation>{} ist nicht ausführbar: {}</translation>
    </message>
    <message>
        <source>{} cannot be set up as a serial line: {}.</source>
        <translation>{} lässt sich nicht als serielle Leitung einrichten: {}.</translation>
    </message>
    <message>
        <source>{} cannot be started.</source>
        <translation>{} lässt sich nicht starten.</translation>
    </message>
    <message>
        <source>{} cannot be started: {}.</source>
        <translation>{} lässt sich nicht starten: {}.</translation>
    </message>
    <message>
        <source>{} cannot be told from {}, because the log lacks what drives the latter: log it next time.</source>
        <translation>{} ist von {} nicht unterscheidbar, weil dem Protokoll fehlt, was letzteren antreibt: beim nächsten Mal aufzeichnen.</translation>
    </message>
    <message>
        <source>{} cannot be written: {}.</source>
        <translation>{} kann nicht geschrieben werden: {}.</translation>
    </message>
    <message>
        <source>{} changes no prediction: it keeps its value {}.</source>
        <translation>{} ändert keine Vorhersage: der Wert {} bleibt.</translation>
    </message>
    <message>
        <source>{} contrast curves share one shape</source>
        <translation>{} Kontrastkurven haben eine gemeinsame Form</translation>
    </message>
    <message>
        <source>{} cycles are too few for a high-pass over {} cycles; allowed: at least {}</source>
        <translation>{} Zyklen sind zu wenige für einen Hochpass über {} Zyklen; zulässig: mindestens {}</translation>
    </message>
    <message>
        <source>{} cycles are too many to replay; give a longer --cycle.</source>
        <translation>{} Zyklen sind zu viele zum Nachspielen; einen längeren --cycle angeben.</translation>
    </message>
    <message>
        <source>{} cycles fall into the record of the reference instrument; at least 3 are needed</source>
        <translation>{} Zyklen fallen in die Aufzeichnung des Referenzgeräts; mindestens 3 sind nötig</translation>
    </message>
    <message>
        <source>{} decoded, blur {:.1f} px, centres within {:.3f} px rms of the pattern.</source>
        <translation>{} decodiert, Unschärfe {:.1f} px, Zentren innerhalb {:.3f} px rms des Musters.</translation>
    </message>
    <message>
        <source>{} directions</source>
        <translation>{} Richtungen</translation>
    </message>
    <message>
        <source>{} does not answer as a broker.</source>
        <translation>{} antwortet nicht als Broker.</translation>
    </message>
    <message>
        <source>{} does not become &quot;{} {}&quot; within {:g} s{}</source>
        <translation>{} wird nicht innerhalb von {3:g} s zu „{1} {2}“{4}</translation>
    </message>
    <message>
        <source>{} refuses remote control: wrong password of linuxcncrsh (--enablepw).</source>
        <translation>{} verweigert die Fernsteuerung: falsches Passwort von linuxcncrsh (--enablepw).</translation>
    </message>
    <message>
        <source>{} does not run the program: {}</source>
        <translation>{} führt das Programm nicht aus: {}</translation>
    </message>
    <message>
        <source>{} ellipses and {} circles</source>
        <translation>{} Ellipsen und {} Kreise</translation>
    </message>
    <message>
        <source>{} ellipses were found, but the numbers in them cannot be read for certain (correlation {:.2f})</source>
        <translation>{} Ellipsen wurden gefunden, aber ihre Nummern sind nicht sicher lesbar (Korrelation {:.2f})</translation>
    </message>
    <message>
        <source>{} ended the stream{}.</source>
        <translation>{} beendete den Datenstrom{}.</translation>
    </message>
    <message>
        <source>{} ended with exit status {}; allowed: 0 or 1.</source>
        <translation>{} endete mit Status {}; zulässig: 0 oder 1.</translation>
    </message>
    <message>
        <source>{} ended: {}.</source>
        <translation>{} beendet: {}.</translation>
    </message>
    <message>
        <source>{} ends at its bound {}: the data ask for {}; widen &quot;{}&quot; or look for another cause.</source>
        <translation>{} endet an der Grenze {}: die Daten verlangen {}; „{}“ erweitern oder eine andere Ursache suchen.</translation>
    </message>
    <message>
        <source>{} fields instead of {}{}; allowed: {} fields separated by commas, numbers with a decimal point.</source>
        <translation>{} Felder statt {}{}; zulässig: {} durch Kommas getrennte Felder, Zahlen mit Dezimalpunkt.</translation>
    </message>
    <message>
        <source>{} fixed positions are more than the {} to be chosen.</source>
        <translation>{} feste Positionen sind mehr als die {} zu wählenden.</translation>
    </message>
    <message>
        <source>{} from {}</source>
        <translation>{} ab {}</translation>
    </message>
    <message>
        <source>{} gives {} entries for {} FIELDS.</source>
        <translation>{} hat {} Einträge für {} FIELDS.</translation>
    </message>
    <message>
        <source>{} groups of {} temperatures are not possible; allowed: 1 to {}.</source>
        <translation>{} Gruppen von {} Temperaturen sind nicht möglich; zulässig: 1 bis {}.</translation>
    </message>
    <message>
        <source>{} h {} min</source>
        <translation>{} h {} min</translation>
    </message>
    <message>
        <source>{} has no compensation channel (comp-x, offset-x, watchdog).</source>
        <translation>{} hat keinen Kompensationskanal (comp-x, offset-x, watchdog).</translation>
    </message>
    <message>
        <source>{} has no data item &quot;{}&quot;.</source>
        <translation>{} hat keinen Datenpunkt „{}“.</translation>
    </message>
    <message>
        <source>{} has no extent in x and y: all points lie at one place.</source>
        <translation>{} hat keine Ausdehnung in x und y: alle Punkte liegen an einer Stelle.</translation>
    </message>
    <message>
        <source>{} has no extent in x or y.</source>
        <translation>{} hat keine Ausdehnung in x oder y.</translation>
    </message>
    <message>
        <source>{} has no heat map: {}</source>
        <translation>{} hat keine Farbkarte: {}</translation>
    </message>
    <message>
        <source>{} has no model of higher order: {}</source>
        <translation>{} hat kein Modell höherer Ordnung: {}</translation>
    </message>
    <message>
        <source>{} has no name; allowed: letters and digits, such as B1.</source>
        <translation>{} hat keinen Namen; zulässig: Buchstaben und Ziffern, etwa B1.</translation>
    </message>
    <message>
        <source>{} has no parameter &quot;{}&quot;; allowed: {}.</source>
        <translation>{} hat keinen Parameter „{}“; zulässig: {}.</translation>
    </message>
    <message>
        <source>{} has no value: {} gave none of {}.</source>
        <translation>{} hat keinen Wert: {} lieferte keinen von {}.</translation>
    </message>
    <message>
        <source>{} has no {} in {}</source>
        <translation>{} hat keine {} in {}</translation>
    </message>
    <message>
        <source>{} has overwritten what followed.</source>
        <translation>{} hat das Folgende überschrieben.</translation>
    </message>
    <message>
        <source>{} has said nothing for {:.0f} s.</source>
        <translation>{} schweigt seit {:.0f} s.</translation>
    </message>
    <message>
        <source>{} has {} measuring times; allowed: at least 8 to find an offset.</source>
        <translation>{} hat {} Messzeitpunkte; zulässig: mindestens 8, um einen Versatz zu finden.</translation>
    </message>
    <message>
        <source>{} has {} readings; allowed: at least {} over the test.</source>
        <translation>{} hat {} Messwerte; zulässig: mindestens {} über die Prüfung.</translation>
    </message>
    <message>
        <source>{} has {} usable focus heights; at least 5 are needed.</source>
        <translation>{} hat {} verwendbare Fokushöhen; mindestens 5 sind nötig.</translation>
    </message>
    <message>
        <source>{} holds another compensation than was written.</source>
        <translation>{} enthält eine andere Kompensation als geschrieben.</translation>
    </message>
    <message>
        <source>{} holds no points.</source>
        <translation>{} enthält keine Punkte.</translation>
    </message>
    <message>
        <source>{} holds no smooth surface: only {:.0f} of {} points agree with their neighbours.</source>
        <translation>{} enthält keine glatte Fläche: nur {:.0f} von {} Punkten stimmen mit ihren Nachbarn überein.</translation>
    </message>
    <message>
        <source>{} holds only {} points; at least {} are needed.</source>
        <translation>{} enthält nur {} Punkte; mindestens {} sind nötig.</translation>
    </message>
    <message>
        <source>{} holds two separate surfaces ({}); allowed: one artefact per cloud.</source>
        <translation>{} enthält zwei getrennte Flächen ({}); zulässig: ein Prüfkörper je Punktwolke.</translation>
    </message>
    <message>
        <source>{} hours for the next measurement are not allowed; allowed: above 0, at most 72.</source>
        <translation>{} Stunden für die nächste Messung sind nicht zulässig; zulässig: über 0, höchstens 72.</translation>
    </message>
    <message>
        <source>{} in state {}</source>
        <translation>{} in Zustand {}</translation>
    </message>
    <message>
        <source>{} in {}: too few observations per series after removing the offset of each of {} series, so the missing effect, its time constant and whether it is one at all cannot be decided; measure {}.</source>
        <translation>{} in {}: zu wenige Beobachtungen je Reihe nach Abzug des Versatzes jeder von {} Reihen, daher lassen sich der fehlende Effekt, seine Zeitkonstante und ob es überhaupt einer ist, nicht entscheiden; zu messen: {}.</translation>
    </message>
    <message>
        <source>{} inputs with {} gains each are not allowed; allowed: at most {} gains at a time.</source>
        <translation>{} Eingänge mit je {} Verstärkungen sind nicht zulässig; zulässig: höchstens {} Verstärkungen zugleich.</translation>
    </message>
    <message>
        <source>{} inputs, {} time constants</source>
        <translation>{} Eingänge, {} Zeitkonstanten</translation>
    </message>
    <message>
        <source>{} inputs, {} time constants, {} bins of {:.6g} s</source>
        <translation>{} Eingänge, {} Zeitkonstanten, {} Intervalle zu {:.6g} s</translation>
    </message>
    <message>
        <source>{} is a parameter of several kinds of results of {}; allowed: {}/{} or {}.</source>
        <translation>{} ist ein Parameter mehrerer Arten von Ergebnissen von {}; zulässig: {}/{} oder {}.</translation>
    </message>
    <message>
        <source>{} is a time of a load between {} and {}: it can only be put in together with that load.</source>
        <translation>{} ist ein Zeitpunkt einer Last zwischen {} und {}: er lässt sich nur zusammen mit dieser Last einsetzen.</translation>
    </message>
    <message>
        <source>{} is an output and an input; an error cannot predict itself.</source>
        <translation>{} ist Ausgang und Eingang; eine Abweichung kann sich nicht selbst vorhersagen.</translation>
    </message>
    <message>
        <source>{} is back at {:.3f} s</source>
        <translation>{} ist wieder da bei {:.3f} s</translation>
    </message>
    <message>
        <source>{} is compensated by the {}: {:.1f} µm off against {:.1f} µm</source>
        <translation>{} wird kompensiert durch {}: {:.1f} µm Abweichung gegen {:.1f} µm</translation>
    </message>
    <message>
        <source>{} is gone: its motion does not run any more.</source>
        <translation>{} ist ausgefallen: seine Bewegungssteuerung läuft nicht mehr.</translation>
    </message>
    <message>
        <source>{} is lost: {}</source>
        <translation>{} ist ausgefallen: {}</translation>
    </message>
    <message>
        <source>A model of {} is needed (the nine parameters alone: probability {:.2g}); it predicts points left out to {:.2f} µm, the nine parameters to {:.2f} µm.</source>
        <translation>Ein Modell von {} ist nötig (die neun Parameter allein: Wahrscheinlichkeit {:.2g}); es sagt ausgelassene Punkte auf {:.2f} µm vorher, die neun Parameter auf {:.2f} µm.</translation>
    </message>
    <message>
        <source>{} is not allowed; a length in µm greater than zero is needed.</source>
        <translation>{} ist nicht zulässig; nötig ist eine Länge in µm größer als null.</translation>
    </message>
    <message>
        <source>{} is not allowed; allowed: {}.</source>
        <translation>{} ist nicht zulässig; zulässig: {}.</translation>
    </message>
    <message>
        <source>{} is not connected.</source>
        <translation>{} ist nicht verbunden.</translation>
    </message>
    <message>
        <source>{} is not empty; allowed: a new or empty folder, or that of the same loop.</source>
        <translation>{} ist nicht leer; zulässig: ein neuer oder leerer Ordner oder der desselben Regelkreises.</translation>
    </message>
    <message>
        <source>{} is not empty; allowed: a new or empty folder.</source>
        <translation>{} ist nicht leer; zulässig: ein neuer oder leerer Ordner.</translation>
    </message>
    <message>
        <source>{} is not known at present: look whether the machine stands still.</source>
        <translation>{} ist zurzeit nicht bekannt: nachsehen, ob die Maschine steht.</translation>
    </message>
    <message>
        <source>{} is not known: {}.</source>
        <translation>{} ist nicht bekannt: {}.</translation>
    </message>
    <message>
        <source>{} is not ordered in profiles; a calibration needs the scan as it was measured.</source>
        <translation>{} ist nicht in Profilen geordnet; eine Kalibrierung braucht den Scan, wie er gemessen wurde.</translation>
    </message>
    <message>
        <source>{} is not read: HAL can be read on the control&apos;s computer only.</source>
        <translation>{} wird nicht gelesen: HAL lässt sich nur auf dem Rechner der Steuerung lesen.</translation>
    </message>
    <message>
        <source>{} is not what the simulator predicts with its own values (up to {}); the simulator&apos;s run is used.</source>
        <translation>{} ist nicht, was der Simulator mit seinen eigenen Werten vorhersagt (bis {}); verwendet wird der Lauf des Simulators.</translation>
    </message>
    <message>
        <source>{} is off by {:+.1f} µm; action control limit {:g} µm</source>
        <translation>{} weicht um {:+.1f} µm ab; Eingriffsgrenze {:g} µm</translation>
    </message>
    <message>
        <source>{} is off by {:.1f} µm at {} (allowed {:.2f} µm)</source>
        <translation>{} weicht um {:.1f} µm ab bei {} (zulässig {:.2f} µm)</translation>
    </message>
    <message>
        <source>{} is outdated</source>
        <translation>{} ist veraltet</translation>
    </message>
    <message>
        <source>{} is taken for the ambient temperature by its name; --ambient names another.</source>
        <translation>{} gilt nach dem Namen als Umgebungstemperatur; --ambient nennt eine andere.</translation>
    </message>
    <message>
        <source>{} is the reference state: its values are zero up to an unknown constant, not deviations.</source>
        <translation>{} ist der Referenzzustand: seine Werte sind bis auf eine unbekannte Konstante null, keine Abweichungen.</translation>
    </message>
    <message>
        <source>{} is there already; this one is kept aside.</source>
        <translation>{} ist schon vorhanden; diese Datei wird beiseitegelegt.</translation>
    </message>
    <message>
        <source>{} is too sparse for a height map: {} points over {:.3g} mm x {:.3g} mm.</source>
        <translation>{} ist zu dünn für eine Höhenkarte: {} Punkte auf {:.3g} mm x {:.3g} mm.</translation>
    </message>
    <message>
        <source>{} is written again.</source>
        <translation>{} wird wieder geschrieben.</translation>
    </message>
    <message>
        <source>{} is {:.2g} wide, which is implausible in mm: the unit seems to be m; allowed: mm.</source>
        <translation>{} ist {:.2g} breit, was in mm unplausibel ist: die Einheit ist anscheinend m; zulässig: mm.</translation>
    </message>
    <message>
        <source>{} is {:.3g} wide and {:.3g} high: its heights seem to be in µm and its x, y in mm; allowed: mm everywhere.</source>
        <translation>{} ist {:.3g} breit und {:.3g} hoch: die Höhen sind anscheinend in µm, x und y in mm; zulässig: überall mm.</translation>
    </message>
    <message>
        <source>{} is {}; allowed: three numbers in mm.</source>
        <translation>{} ist {}; zulässig: drei Zahlen in mm.</translation>
    </message>
    <message>
        <source>{} is {}; allowed: {} {}.</source>
        <translation>{} ist {}; zulässig: {} {}.</translation>
    </message>
    <message>
        <source>{} isolated values of {} were left out of the choice between methods.</source>
        <translation>{} vereinzelte Werte von {} wurden bei der Verfahrenswahl ausgelassen.</translation>
    </message>
    <message>
        <source>{} keeps nothing for a client that is away.</source>
        <translation>{} hebt für einen abwesenden Client nichts auf.</translation>
    </message>
    <message>
        <source>{} leaves the range of training ({:.6g} ... {:.6g}) by up to {:.6g}.</source>
        <translation>{} verlässt den Trainingsbereich ({:.6g} ... {:.6g}) um bis zu {:.6g}.</translation>
    </message>
    <message>
        <source>{} lie before or after the rows of {} ({:.0f} s to {:.0f} s)</source>
        <translation>{} liegen vor oder nach den Zeilen von {} ({:.0f} s bis {:.0f} s)</translation>
    </message>
    <message>
        <source>{} lies where the other cycles have it divided by 25.4: inches; allowed: millimetres.</source>
        <translation>{} liegt dort, wo die anderen Zyklen es durch 25,4 geteilt haben: Zoll; zulässig: Millimeter.</translation>
    </message>
    <message>
        <source>{} lost at {:.3f} s: {}</source>
        <translation>{} ausgefallen bei {:.3f} s: {}</translation>
    </message>
    <message>
        <source>{} may be {}; allowed: the whole name of one column.</source>
        <translation>{} kann {} sein; zulässig: der ganze Name einer Spalte.</translation>
    </message>
    <message>
        <source>{} measured {:+.2f} beside the prediction, limit {:.2f}</source>
        <translation>{} gemessen {:+.2f} neben der Vorhersage, Grenze {:.2f}</translation>
    </message>
    <message>
        <source>{} min</source>
        <translation>{} min</translation>
    </message>
    <message>
        <source>{} minus {}</source>
        <translation>{} minus {}</translation>
    </message>
    <message>
        <source>{} more</source>
        <translation>{} weitere</translation>
    </message>
    <message>
        <source>{} more, {} taken back</source>
        <translation>{} weitere, {} zurückgenommen</translation>
    </message>
    <message>
        <source>{} moves</source>
        <translation>{} Bewegungen</translation>
    </message>
    <message>
        <source>{} no longer has what followed: {}.</source>
        <translation>{} hat das Folgende nicht mehr: {}.</translation>
    </message>
    <message>
        <source>{} nodes along {} are not allowed; allowed: 1 to 1000.</source>
        <translation>{} Stützstellen entlang {} sind nicht zulässig; zulässig: 1 bis 1000.</translation>
    </message>
    <message>
        <source>{} numbers</source>
        <translation>{} Zahlen</translation>
    </message>
    <message>
        <source>{} observations are later than the end of the log and are not fitted.</source>
        <translation>{} Beobachtungen sind später als das Ende des Protokolls und werden nicht zur Anpassung verwendet.</translation>
    </message>
    <message>
        <source>{} observations lie between two rows of the log of different spindle speed and are not fitted: when it changed is not known.</source>
        <translation>{} Beobachtungen liegen zwischen zwei Zeilen des Protokolls mit verschiedener Spindeldrehzahl und werden nicht zur Anpassung verwendet: der Zeitpunkt der Änderung ist nicht bekannt.</translation>
    </message>
    <message>
        <source>{} of 3 axes are switched by it</source>
        <translation>{} von 3 Achsen werden davon geschaltet</translation>
    </message>
    <message>
        <source>{} of all points has a common time history{}, {:.2f} {} rms</source>
        <translation>{} aller Punkte hat einen gemeinsamen zeitlichen Verlauf{}, {:.2f} {} rms</translation>
    </message>
    <message>
        <source>duplicate {} of point {} at {} s; allowed: one row per observation.</source>
        <translation>{} des Punkts {} bei {} s doppelt; zulässig: eine Zeile je Beobachtung.</translation>
    </message>
    <message>
        <source>{} of point {} is {:g} mm, the travel {:g} to {:g} mm</source>
        <translation>{} des Punkts {} ist {:g} mm, der Verfahrweg {:g} bis {:g} mm</translation>
    </message>
    <message>
        <source>{} of points and components {} not measured alike before and after; only what both have is compared.</source>
        <translation>{} der Punkte und Komponenten {} vorher und nachher nicht gleich gemessen; verglichen wird nur, was beide haben.</translation>
    </message>
    <message>
        <source>{} of state {}</source>
        <translation>{} von Zustand {}</translation>
    </message>
    <message>
        <source>{} of the rotary table about {}</source>
        <translation>{} des Drehtisches um {}</translation>
    </message>
    <message>
        <source>{} of {}</source>
        <translation>{} von {}</translation>
    </message>
    <message>
        <source>duplicate {} of {} at {} s; allowed: one prediction each.</source>
        <translation>{} von {} bei {} s doppelt; zulässig: je eine Vorhersage.</translation>
    </message>
    <message>
        <source>{} of {} captures are checked.</source>
        <translation>{} von {} Aufnahmen sind geprüft.</translation>
    </message>
    <message>
        <source>{} of {} captures could not be used and were left out.</source>
        <translation>{} von {} Aufnahmen waren unbrauchbar und wurden ausgelassen.</translation>
    </message>
    <message>
        <source>{} of {} images show {} different spindle orientation{}; at least 3 are needed for the centre of rotation.</source>
        <translation>{} von {} Bildern zeigen {} verschiedene Spindelstellung{}; für das Drehzentrum sind mindestens 3 nötig.</translation>
    </message>
    <message>
        <source>{} of {} observations have no prediction in the simulation and are left out{}.</source>
        <translation>{} von {} Beobachtungen haben keine Vorhersage in der Simulation und werden ausgelassen{}.</translation>
    </message>
    <message>
        <source>{} of {} planned captures are taken.</source>
        <translation>{} von {} geplanten Aufnahmen sind gemacht.</translation>
    </message>
    <message>
        <source>{} of {} points lie far outside the travel of this machine ({}): are these its observations, in mm?</source>
        <translation>{} von {} Punkten liegen weit außerhalb des Verfahrwegs dieser Maschine ({}): sind dies ihre Beobachtungen, in mm?</translation>
    </message>
    <message>
        <source>{} of {} samples of the output were bridged over gaps.</source>
        <translation>{} von {} Abtastwerten des Ausgangs wurden über Lücken überbrückt.</translation>
    </message>
    <message>
        <source>{} of {} touches of {} do not fit: the columns x_mm and y_mm swapped, approach vectors of the wrong sign, or a diameter or stylus in machine.json that is not the one used?</source>
        <translation>{} von {} Antastungen von {} passen nicht: Spalten x_mm und y_mm vertauscht, Anfahrvektoren mit falschem Vorzeichen, oder Durchmesser oder Tastereinsatz in machine.json nicht der verwendete?</translation>
    </message>
    <message>
        <source>{} of {} values are missing in the training range</source>
        <translation>{} von {} Werten fehlen im Trainingsbereich</translation>
    </message>
    <message>
        <source>{} of {} values of {} are missing.</source>
        <translation>{} von {} Werten von {} fehlen.</translation>
    </message>
    <message>
        <source>{} of {} {}</source>
        <translation>{} von {} {}</translation>
    </message>
    <message>
        <source>{} of {} {} the same as before to the last digit: is it the same measurement?</source>
        <translation>{} von {} {} bis zur letzten Stelle wie zuvor: ist es dieselbe Messung?</translation>
    </message>
    <message>
        <source>{} of {} {} were taken while the control was compensating (compensation_on = 1) and are left out: they show what the compensation leaves, not the error.</source>
        <translation>{} von {} {} entstanden, während die Steuerung kompensierte (compensation_on = 1), und werden ausgelassen: sie zeigen, was die Kompensation übrig lässt, nicht die Abweichung.</translation>
    </message>
    <message>
        <source>{} of {}{}</source>
        <translation>{} von {}{}</translation>
    </message>
    <message>
        <source>{} on top of {}</source>
        <translation>{} zusätzlich zu {}</translation>
    </message>
    <message>
        <source>{} open: {}</source>
        <translation>{} offen: {}</translation>
    </message>
    <message>
        <source>{} others explain the same as well</source>
        <translation>{} andere erklären dasselbe ebenso gut</translation>
    </message>
    <message>
        <source>{} parameters cannot be determined</source>
        <translation>{} Parameter sind nicht bestimmbar</translation>
    </message>
    <message>
        <source>{} points</source>
        <translation>{} Punkte</translation>
    </message>
    <message>
        <source>{} too few for a line; allowed: at least 2</source>
        <translation>{} zu wenig für eine Gerade; zulässig: mindestens 2</translation>
    </message>
    <message>
        <source>{} too few for a plane; allowed: at least 3</source>
        <translation>{} zu wenig für eine Ebene; zulässig: mindestens 3</translation>
    </message>
    <message>
        <source>{} too few for a {}{}; allowed: at least {}</source>
        <translation>{} zu wenig für die Form {}{}; zulässig: mindestens {}</translation>
    </message>
    <message>
        <source>{} points for the next measurement are not allowed; allowed: 1 to 50.</source>
        <translation>{} Punkte für die nächste Messung sind nicht zulässig; zulässig: 1 bis 50.</translation>
    </message>
    <message>
        <source>{} positions along an axis are not allowed; allowed: 2 to 51.</source>
        <translation>{} Positionen entlang einer Achse sind nicht zulässig; zulässig: 2 bis 51.</translation>
    </message>
    <message>
        <source>{} positions are not allowed; allowed: 2 to {}.</source>
        <translation>{} Positionen sind nicht zulässig; zulässig: 2 bis {}.</translation>
    </message>
    <message>
        <source>{} positions are not enough; allowed: 3 or more for the nine parameters.</source>
        <translation>{} Positionen genügen nicht; zulässig: 3 oder mehr für die neun Parameter.</translation>
    </message>
    <message>
        <source>{} positions cannot be chosen from {} candidates.</source>
        <translation>{} Positionen lassen sich nicht aus {} Kandidaten wählen.</translation>
    </message>
    <message>
        <source>{} predicts {} {}, which neither machine.json nor the observations know.</source>
        <translation>{} sagt {} {} vorher, die weder machine.json noch die Beobachtungen kennen.</translation>
    </message>
    <message>
        <source>{} readings</source>
        <translation>{} Messwerte</translation>
    </message>
    <message>
        <source>{} readings are compared with the simulation</source>
        <translation>{} Messwerte werden mit der Simulation verglichen</translation>
    </message>
    <message>
        <source>{} readings of the axis; allowed: at least 4 at each of two positions.</source>
        <translation>{} Messwerte der Achse; zulässig: mindestens 4 an jeder von zwei Positionen.</translation>
    </message>
    <message>
        <source>{} refuses &quot;get {}&quot;.</source>
        <translation>{} lehnt „get {}“ ab.</translation>
    </message>
    <message>
        <source>{} refuses &quot;{}&quot;{}</source>
        <translation>{} verweigert „{}“{}</translation>
    </message>
    <message>
        <source>{} refuses register {}: {}.</source>
        <translation>{} verweigert Register {}: {}.</translation>
    </message>
    <message>
        <source>{} refuses: {}</source>
        <translation>{} verweigert: {}</translation>
    </message>
    <message>
        <source>{} rotations, {} steps and {} heights are too few; allowed: at least 3, 3 and 5.</source>
        <translation>{} Drehungen, {} Schritte und {} Höhen sind zu wenige; zulässig: mindestens 3, 3 und 5.</translation>
    </message>
    <message>
        <source>{} rounds of tasks brought no answer; the last log says: {}</source>
        <translation>{} Runden von Aufgaben brachten keine Antwort; das letzte Protokoll sagt: {}</translation>
    </message>
    <message>
        <source>{} rows and {} columns are not allowed; at least one of each is needed.</source>
        <translation>{} Zeilen und {} Spalten sind nicht zulässig; mindestens je eine ist nötig.</translation>
    </message>
    <message>
        <source>{} rows repeat the time of the row before.</source>
        <translation>{} Zeilen wiederholen die Zeit der Zeile davor.</translation>
    </message>
    <message>
        <source>{} samples are too few for {} parameters; allowed: at least {} samples (a longer range, a shorter period or a lower order).</source>
        <translation>{} Abtastwerte sind zu wenige für {} Parameter; zulässig: mindestens {} (längerer Bereich, kürzere Periode oder niedrigere Ordnung).</translation>
    </message>
    <message>
        <source>{} samples are too few for {} parameters; allowed: at least {} samples.</source>
        <translation>{} Abtastwerte sind zu wenige für {} Parameter; zulässig: mindestens {}.</translation>
    </message>
    <message>
        <source>{} samples are too few to choose inputs; allowed: at least 40 in the training range.</source>
        <translation>{} Abtastwerte sind zu wenige zur Wahl der Eingänge; zulässig: mindestens 40 im Trainingsbereich.</translation>
    </message>
    <message>
        <source>{} seems to have grown by {} in {}, but its expansion coefficient and temperature say {}: the axis that measures it grows as well, the expansion coefficient is wrong, or the sensor is not on the artefact.</source>
        <translation>{} ist anscheinend um {} in {} gewachsen, aber Ausdehnungskoeffizient und Temperatur ergeben {}: die messende Achse wächst ebenfalls, der Ausdehnungskoeffizient ist falsch, oder der Sensor sitzt nicht auf dem Prüfkörper.</translation>
    </message>
    <message>
        <source>{} sends a document that is not XML.</source>
        <translation>{} sendet ein Dokument, das kein XML ist.</translation>
    </message>
    <message>
        <source>{} sends a document that is not XML: {}.</source>
        <translation>{} sendet ein Dokument, das kein XML ist: {}.</translation>
    </message>
    <message>
        <source>{} sends a document without an end.</source>
        <translation>{} sendet ein Dokument ohne Ende.</translation>
    </message>
    <message>
        <source>{} sends a line without an end.</source>
        <translation>{} sendet eine Zeile ohne Ende.</translation>
    </message>
    <message>
        <source>{} sends no JSON.</source>
        <translation>{} sendet kein JSON.</translation>
    </message>
    <message>
        <source>{} sends no Sparkplug payload.</source>
        <translation>{} sendet keine Sparkplug-Nutzdaten.</translation>
    </message>
    <message>
        <source>{} so far</source>
        <translation>{} bisher</translation>
    </message>
    <message>
        <source>duplicate name {}; allowed: every name once.</source>
        <translation>doppelter Name {}; zulässig: jeder Name einmal.</translation>
    </message>
    <message>
        <source>{} stands {:.1f} mm beside where the machine file has it; its place in the machine file enters the evaluation.</source>
        <translation>{} steht {:.1f} mm neben der Stelle in der Maschinendatei; seine Lage in der Maschinendatei geht in die Auswertung ein.</translation>
    </message>
    <message>
        <source>{} starts at {:.1f} where the others start near {:.1f}: it may be in Fahrenheit; if so, rename the column to end in _degF.</source>
        <translation>{} beginnt bei {:.1f}, die anderen nahe {:.1f}: möglicherweise in Fahrenheit; falls ja, die Spalte auf _degF umbenennen.</translation>
    </message>
    <message>
        <source>{} stood more than {:g} mm elsewhere before, and is left out.</source>
        <translation>{} stand zuvor mehr als {:g} mm entfernt und wird ausgelassen.</translation>
    </message>
    <message>
        <source>{} taken back</source>
        <translation>{} zurückgenommen</translation>
    </message>
    <message>
        <source>{} temperatures</source>
        <translation>{} Temperaturen</translation>
    </message>
    <message>
        <source>{} thermal states; allowed: 1 to 1000.</source>
        <translation>{} thermische Zustände; zulässig: 1 bis 1000.</translation>
    </message>
    <message>
        <source>{} times for the next measurement are not allowed; allowed: 3 to 200.</source>
        <translation>{} Zeitpunkte für die nächste Messung sind nicht zulässig; zulässig: 3 bis 200.</translation>
    </message>
    <message>
        <source>{} to {}</source>
        <translation>{} bis {}</translation>
    </message>
    <message>
        <source>{} to {} in {}</source>
        <translation>{} bis {} in {}</translation>
    </message>
    <message>
        <source>{} too {} in the simulation: {} there, measured {}</source>
        <translation>{} zu {} in der Simulation: dort {}, gemessen {}</translation>
    </message>
    <message>
        <source>{} too few to qualify a stylus; allowed: at least 5</source>
        <translation>{} zu wenig, um einen Tastereinsatz zu qualifizieren; zulässig: mindestens 5</translation>
    </message>
    <message>
        <source>{} values in the setup of {:.4g} h and {} after it; allowed: at least 20 and 2 (give another --setup).</source>
        <translation>{} Werte in der Anlernphase von {:.4g} h und {} danach; zulässig: mindestens 20 und 2 (eine andere --setup angeben).</translation>
    </message>
    <message>
        <source>{} values of {} have no row within {} s and were left out.</source>
        <translation>{} Werte von {} haben keine Zeile innerhalb von {} s und wurden ausgelassen.</translation>
    </message>
    <message>
        <source>{} values since {}: control limits begin with the fifth.</source>
        <translation>{} Werte seit {}: Eingriffsgrenzen beginnen mit dem fünften.</translation>
    </message>
    <message>
        <source>{} values: changes are looked for from {} on.</source>
        <translation>{} Werte: Änderungen werden ab {} gesucht.</translation>
    </message>
    <message>
        <source>{} was accepted by hand; the data do not support it.</source>
        <translation>{} wurde von Hand angenommen; die Daten stützen es nicht.</translation>
    </message>
    <message>
        <source>{} was accepted by hand; {} in its place is more probable with these data ({:.2f} against {:.2f}).</source>
        <translation>{} wurde von Hand angenommen; {} an seiner Stelle ist mit diesen Daten wahrscheinlicher ({:.2f} gegen {:.2f}).</translation>
    </message>
    <message>
        <source>{} was asked for, but these data do not support it: {} is no more than {:g} standard uncertainties from the {} before.</source>
        <translation>{} wurde verlangt, aber diese Daten stützen es nicht: {} ist nicht mehr als {:g} Standardunsicherheiten von {} zuvor entfernt.</translation>
    </message>
    <message>
        <source>{} was ended by signal {}</source>
        <translation>{} wurde durch Signal {} beendet</translation>
    </message>
    <message>
        <source>{} was entered</source>
        <translation>{} wurde eingetragen</translation>
    </message>
    <message>
        <source>{} was entered for {}, after the model&apos;s campaign {}</source>
        <translation>{} wurde für {} eingetragen, nach der Kampagne {} des Modells</translation>
    </message>
    <message>
        <source>{} was never reached: {}</source>
        <translation>{} wurde nie erreicht: {}</translation>
    </message>
    <message>
        <source>{} was not connected: stopped.</source>
        <translation>{} war nicht verbunden: angehalten.</translation>
    </message>
    <message>
        <source>{} was not measured in the reference state {} and is left out.</source>
        <translation>{} wurde im Referenzzustand {} nicht gemessen und wird ausgelassen.</translation>
    </message>
    <message>
        <source>{} was read in {} and converted to degC.</source>
        <translation>{} wurde in {} gelesen und in degC umgerechnet.</translation>
    </message>
    <message>
        <source>{} was rejected by hand; the data do not ask for it either.</source>
        <translation>{} wurde von Hand verworfen; die Daten verlangen ihn auch nicht.</translation>
    </message>
    <message>
        <source>{} was rejected by hand; with it considered its probability is {:.2f}{}.</source>
        <translation>{} wurde von Hand verworfen; berücksichtigt wäre seine Wahrscheinlichkeit {:.2f}{}.</translation>
    </message>
    <message>
        <source>{} was started anew.</source>
        <translation>{} wurde neu gestartet.</translation>
    </message>
    <message>
        <source>{} with its lack of fit</source>
        <translation>{} mit seiner mangelnden Anpassung</translation>
    </message>
    <message>
        <source>{} with stylus {}: the touches lie on a radius of {:.4f} mm, the machine file gives {:.4f} mm; check diameter and stylus radius (displacements do not depend on it).</source>
        <translation>{} mit Tastereinsatz {}: die Antastungen liegen auf einem Radius von {:.4f} mm, die Maschinendatei gibt {:.4f} mm an; Durchmesser und Radius des Tastereinsatzes prüfen (Verschiebungen hängen nicht davon ab).</translation>
    </message>
    <message>
        <source>{} without time constant</source>
        <translation>{} ohne Zeitkonstante</translation>
    </message>
    <message>
        <source>{} workers vanished over items {} to {}</source>
        <translation>{} Arbeitsprozesse verschwanden bei den Elementen {} bis {}</translation>
    </message>
    <message>
        <source>{} {:.6g}:{:.6g} holds no measured value of {}; the record runs from {:.6g} to {:.6g} s.</source>
        <translation>{} {:.6g}:{:.6g} enthält keinen Messwert von {}; die Aufzeichnung reicht von {:.6g} bis {:.6g} s.</translation>
    </message>
    <message>
        <source>{} {} far from all others and {} little weight: {}.</source>
        <translation>{} {} weit von allen anderen entfernt und {} wenig Gewicht: {}.</translation>
    </message>
    <message>
        <source>{} {} gives a number that is not finite; column {} is empty there.</source>
        <translation>{} {} liefert eine nicht endliche Zahl; Spalte {} bleibt dort leer.</translation>
    </message>
    <message>
        <source>{} {} is in {}, which cannot become {}: column {} stays empty.</source>
        <translation>{} {} ist in {}, das nicht in {} umgerechnet werden kann: Spalte {} bleibt leer.</translation>
    </message>
    <message>
        <source>{} {} is not allowed; allowed: deviations up to {:g} {} in size.</source>
        <translation>{} {} ist nicht zulässig; zulässig: Abweichungen bis {:g} {} Betrag.</translation>
    </message>
    <message>
        <source>{} {} is not allowed; allowed: greater than zero.</source>
        <translation>{} {} ist nicht zulässig; zulässig: größer als null.</translation>
    </message>
    <message>
        <source>{} {} is not allowed; allowed: {} to {}.</source>
        <translation>{} {} ist nicht zulässig; zulässig: {} bis {}.</translation>
    </message>
    <message>
        <source>duplicate {} {} of fiducial {} in state {}, first in {}; allowed: one row each.</source>
        <translation>{} {} der Messmarke {} in Zustand {} doppelt, zuerst in {}; zulässig: je eine Zeile.</translation>
    </message>
    <message>
        <source>{} {} read at one point only: whether the state was shifted or the point moved cannot be told there.</source>
        <translation>{} {} nur an einem Punkt abgelesen: ob der Zustand verschoben war oder der Punkt sich bewegte, lässt sich dort nicht sagen.</translation>
    </message>
    <message>
        <source>{} {} says &quot;{}&quot;, which is neither a number nor among &quot;values&quot; of column {}.</source>
        <translation>{} {} liefert „{}“, das weder eine Zahl ist noch unter &quot;values&quot; der Spalte {} steht.</translation>
    </message>
    <message>
        <source>{} {} {:g} to {:g}</source>
        <translation>{} {} {:g} bis {:g}</translation>
    </message>
    <message>
        <source>{} {}, and now it is {}; allowed: a log of the past, and a clock that is right.</source>
        <translation>{} {}, und jetzt ist {}; zulässig: ein Protokoll der Vergangenheit und eine richtig gehende Uhr.</translation>
    </message>
    <message>
        <source>{} {}/{} {} at {} deg, touch {}</source>
        <translation>{} {}/{} {} bei {} deg, Antastung {}</translation>
    </message>
    <message>
        <source>{}); registered as free-form clouds.</source>
        <translation>{}); als Freiform-Punktwolken registriert.</translation>
    </message>
    <message>
        <source>{}, _pi, _e and the functions of muParser</source>
        <translation>{}, _pi, _e und die Funktionen von muParser</translation>
    </message>
    <message>
        <source>{}, line {}: {{{{{}}}}} has no finite value with {}.</source>
        <translation>{}, Zeile {}: {{{{{}}}}} hat keinen endlichen Wert mit {}.</translation>
    </message>
    <message>
        <source>{}, such as {}</source>
        <translation>{}, etwa {}</translation>
    </message>
    <message>
        <source>{}, touch {}</source>
        <translation>{}, Antastung {}</translation>
    </message>
    <message>
        <source>{}/current has no nextSequence.</source>
        <translation>{}/current hat kein nextSequence.</translation>
    </message>
    <message>
        <source>{}/probe answers, but not with MTConnectDevices.</source>
        <translation>{}/probe antwortet, aber nicht mit MTConnectDevices.</translation>
    </message>
    <message>
        <source>{}/sample answers &quot;{}&quot;.</source>
        <translation>{}/sample antwortet „{}“.</translation>
    </message>
    <message>
        <source>{}: do not compensate with it; train on a longer or more varied range.</source>
        <translation>{}: nicht damit kompensieren; an einem längeren oder abwechslungsreicheren Bereich trainieren.</translation>
    </message>
    <message>
        <source>{}: it has no deviation in {} in {}.</source>
        <translation>{}: keine Abweichung in {} in {}.</translation>
    </message>
    <message>
        <source>{}: it has no deviation in {} there.</source>
        <translation>{}: keine Abweichung in {} dort.</translation>
    </message>
    <message>
        <source>{}: message {} came in place of {}.</source>
        <translation>{}: Nachricht {} kam anstelle von {}.</translation>
    </message>
    <message>
        <source>{}: no client can be made.</source>
        <translation>{}: es lässt sich kein Client anlegen.</translation>
    </message>
    <message>
        <source>{}: only {} of {} points are left ({} masked, {} near edges, {} outliers); at least {} are needed.</source>
        <translation>{}: nur {} von {} Punkten bleiben ({} maskiert, {} nahe Kanten, {} Ausreißer); mindestens {} sind nötig.</translation>
    </message>
    <message>
        <source>{}: the gap of the simulation&apos;s own new run {} is {:.2f} µm, before {:.2f} µm (noise {:.2f} µm).</source>
        <translation>{}: die Differenz des eigenen neuen Laufs der Simulation {} beträgt {:.2f} µm, vorher {:.2f} µm (Rauschen {:.2f} µm).</translation>
    </message>
    <message>
        <source>{}: the images say that the spindle turned {:.1f}° further than spindle_deg says between {} and {}.</source>
        <translation>{}: laut den Bildern drehte die Spindel um {:.1f}° weiter, als spindle_deg zwischen {} und {} angibt.</translation>
    </message>
    <message>
        <source>{}: the scan fits the reference only {:.1f} mm away from where it was taken, on {:.0f} % of the surface; allowed: {:.1f} mm. Something lies over it, or it is another artefact.</source>
        <translation>{}: der Scan passt nur {:.1f} mm neben der Aufnahmestelle zur Referenz, auf {:.0f} % der Fläche; zulässig: {:.1f} mm. Etwas liegt darauf, oder es ist ein anderer Prüfkörper.</translation>
    </message>
    <message>
        <source>{}: there is not enough memory for the cloud.</source>
        <translation>{}: der Speicher reicht für die Punktwolke nicht aus.</translation>
    </message>
    <message>
        <source>{}: took longer than {} s and did not stop when asked to</source>
        <translation>{}: dauerte länger als {} s und hielt auf Aufforderung nicht an</translation>
    </message>
    <message>
        <source>{}: values between {:.3f} s and {:.3f} s may be missing: {}</source>
        <translation>{}: Werte zwischen {:.3f} s und {:.3f} s können fehlen: {}</translation>
    </message>
    <message>
        <source>{}: {:.3f} s to {:.3f} s: {}</source>
        <translation>{}: {:.3f} s bis {:.3f} s: {}</translation>
    </message>
    <message>
        <source>{}: {} of {} touches are missing; {}.</source>
        <translation>{}: {} von {} Antastungen fehlen; {}.</translation>
    </message>
    <message>
        <source>{}:{:02} min</source>
        <translation>{}:{:02} min</translation>
    </message>
    <message>
        <source>{}; left out</source>
        <translation>{}; ausgelassen</translation>
    </message>
    <message>
        <source>{}&quot; is given twice; allowed: every column once.</source>
        <translation>{}“ ist zweimal angegeben; zulässig: jede Spalte einmal.</translation>
    </message>
    <message>
        <source>{}&quot; is not a simulation by its ending; allowed: .csv, a model (.json), or a map of finite-element results (.json).</source>
        <translation>{}“ ist nach der Endung keine Simulation; zulässig: .csv, ein Modell (.json) oder eine Zuordnung von Finite-Elemente-Ergebnissen (.json).</translation>
    </message>
    <message>
        <source>{}&quot; without drivers (its time is unknown), or &quot;none&quot; or &quot;lag&quot; with them</source>
        <translation>{}“ ohne Antriebsgrößen (der Zeitpunkt ist unbekannt), oder &quot;none&quot; oder &quot;lag&quot; mit ihnen</translation>
    </message>
    <message>
        <source>{}the model has no equivalent in first-order time constants</source>
        <translation>{}das Modell hat keine Entsprechung in Zeitkonstanten erster Ordnung</translation>
    </message>
    <message>
        <source>{}{:.3f} lies outside the travel {} to {} mm</source>
        <translation>{}{:.3f} liegt außerhalb des Verfahrwegs {} bis {} mm</translation>
    </message>
    <message>
        <source>{}{:g} is outside the travel{}</source>
        <translation>{}{:g} liegt außerhalb des Verfahrwegs{}</translation>
    </message>
    <message>
        <source>{}{} answers &quot;{}&quot;.</source>
        <translation>{}{} antwortet „{}“.</translation>
    </message>
    <message>
        <source>{}{} answers with no XML: {}.</source>
        <translation>{}{} antwortet ohne XML: {}.</translation>
    </message>
    <message>
        <source>{}{} answers with status {}.</source>
        <translation>{}{} antwortet mit Status {}.</translation>
    </message>
    <message>
        <source>{}{} has not answered within {:.0f} s.</source>
        <translation>{}{} hat innerhalb von {:.0f} s nicht geantwortet.</translation>
    </message>
    <message>
        <source>1 attempt</source>
        <translation>1 Versuch</translation>
    </message>
    <message>
        <source>1 campaign</source>
        <translation>1 Kampagne</translation>
    </message>
    <message>
        <source>1 capture is</source>
        <translation>1 Aufnahme ist</translation>
    </message>
    <message>
        <source>1 chunk</source>
        <translation>1 Teil</translation>
    </message>
    <message>
        <source>1 cycle</source>
        <translation>1 Zyklus</translation>
    </message>
    <message>
        <source>1 day</source>
        <translation>1 Tag</translation>
    </message>
    <message>
        <source>1 ellipse</source>
        <translation>1 Ellipse</translation>
    </message>
    <message>
        <source>1 exclusion</source>
        <translation>1 Ausschluss</translation>
    </message>
    <message>
        <source>1 item</source>
        <translation>1 Element</translation>
    </message>
    <message>
        <source>1 observation</source>
        <translation>1 Beobachtung</translation>
    </message>
    <message>
        <source>1 planned item</source>
        <translation>1 geplantes Element</translation>
    </message>
    <message>
        <source>1 result</source>
        <translation>1 Ergebnis</translation>
    </message>
    <message>
        <source>1 series</source>
        <translation>1 Reihe</translation>
    </message>
    <message>
        <source>1 touch</source>
        <translation>1 Antastung</translation>
    </message>
    <message>
        <source>1 value</source>
        <translation>1 Wert</translation>
    </message>
    <message>
        <source>{} attempts</source>
        <translation>{} Versuche</translation>
    </message>
    <message>
        <source>{} campaigns</source>
        <translation>{} Kampagnen</translation>
    </message>
    <message>
        <source>{} captures are</source>
        <translation>{} Aufnahmen sind</translation>
    </message>
    <message>
        <source>{} chunks</source>
        <translation>{} Teile</translation>
    </message>
    <message>
        <source>{} cycles</source>
        <translation>{} Zyklen</translation>
    </message>
    <message>
        <source>{} days</source>
        <translation>{} Tage</translation>
    </message>
    <message>
        <source>{} ellipses</source>
        <translation>{} Ellipsen</translation>
    </message>
    <message>
        <source>{} exclusions</source>
        <translation>{} Ausschlüsse</translation>
    </message>
    <message>
        <source>{} items</source>
        <translation>{} Elemente</translation>
    </message>
    <message>
        <source>{} observations</source>
        <translation>{} Beobachtungen</translation>
    </message>
    <message>
        <source>{} planned items</source>
        <translation>{} geplante Elemente</translation>
    </message>
    <message>
        <source>{} results</source>
        <translation>{} Ergebnisse</translation>
    </message>
    <message>
        <source>{} series</source>
        <translation>{} Reihen</translation>
    </message>
    <message>
        <source>{} touches</source>
        <translation>{} Antastungen</translation>
    </message>
    <message>
        <source>{} values</source>
        <translation>{} Werte</translation>
    </message>
    <message>
        <source>converged</source>
        <translation>konvergiert</translation>
    </message>
    <message>
        <source>degenerate</source>
        <translation>unterbestimmt</translation>
    </message>
    <message>
        <source>rejected</source>
        <translation>verworfen</translation>
    </message>
    <message>
        <source>artefact</source>
        <translation>Prüfkörper</translation>
    </message>
    <message>
        <source>bed</source>
        <translation>Bett</translation>
    </message>
    <message>
        <source>column</source>
        <translation>Ständer</translation>
    </message>
    <message>
        <source>coolant</source>
        <translation>Kühlschmierstoff</translation>
    </message>
    <message>
        <source>instrument</source>
        <translation>Messgerät</translation>
    </message>
    <message>
        <source>room</source>
        <translation>Raum</translation>
    </message>
    <message>
        <source>table</source>
        <translation>Tisch</translation>
    </message>
    <message>
        <source>displacement along {} at the origin of the table</source>
        <translation>Verschiebung entlang {} am Ursprung des Tisches</translation>
    </message>
    <message>
        <source>rotation about {} at the origin of the table</source>
        <translation>Drehung um {} am Ursprung des Tisches</translation>
    </message>
    <message>
        <source>squareness of {} to {}</source>
        <translation>Rechtwinkligkeitsabweichung von {} zu {}</translation>
    </message>
    <message>
        <source>thermal expansion along {} over the table</source>
        <translation>thermische Ausdehnung entlang {} über den Tisch</translation>
    </message>
    <message>
        <source>{} of {} captures failed the check. Take them again, or exclude them.</source>
        <translation>{} von {} Aufnahmen haben die Prüfung nicht bestanden. Wiederholen oder ausschließen.</translation>
    </message>
    <message>
        <source>({}, {:g} {} per {})</source>
        <translation>({}, {:g} {} je {})</translation>
    </message>
    <message>
        <source>--set &quot;{}&quot; is not allowed; allowed: NAME=NUMBER, for example EC0Y_urad=20.</source>
        <translation>--set „{}“ ist nicht zulässig; zulässig: NAME=NUMBER, zum Beispiel EC0Y_urad=20.</translation>
    </message>
    <message>
        <source>2 and more</source>
        <translation>2 und mehr</translation>
    </message>
    <message>
        <source>3 and more</source>
        <translation>3 und mehr</translation>
    </message>
    <message>
        <source>8 and more</source>
        <translation>8 und mehr</translation>
    </message>
    <message>
        <source>; driver: {}</source>
        <translation>; Antriebsgröße: {}</translation>
    </message>
    <message>
        <source>; driver right</source>
        <translation>; Antriebsgröße richtig</translation>
    </message>
    <message>
        <source>; size {:.1f} ± {:.1f} {} in {}</source>
        <translation>; Größe {:.1f} ± {:.1f} {} in {}</translation>
    </message>
    <message>
        <source>; {:.1f} µm/m along it</source>
        <translation>; {:.1f} µm/m in Längsrichtung</translation>
    </message>
    <message>
        <source>; {}, {:g} {} per {}</source>
        <translation>; {}, {:g} {} je {}</translation>
    </message>
    <message>
        <source>A campaign and --machine are both given; allowed: one of them.</source>
        <translation>Es sind eine Kampagne und --machine angegeben; zulässig: eines von beiden.</translation>
    </message>
    <message>
        <source>It belongs to: {}.</source>
        <translation>Gehört zu: {}.</translation>
    </message>
    <message>
        <source>It is driven by: {}.</source>
        <translation>Angetrieben von: {}.</translation>
    </message>
    <message>
        <source>Nothing in the log drives it.</source>
        <translation>Nichts im Protokoll treibt es an.</translation>
    </message>
    <message>
        <source>What is missing is largest in {}.</source>
        <translation>Was fehlt, ist am größten in {}.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is named twice; allowed: once.</source>
        <translation>„{}“ ist zweimal benannt; zulässig: einmal.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a parameter of machine &quot;{}&quot;; allowed: {}.</source>
        <translation>„{}“ ist kein Parameter der Maschine „{}“; zulässig: {}.</translation>
    </message>
    <message>
        <source>
{}{}, relative to {}</source>
        <translation>
{}{}, bezogen auf {}</translation>
    </message>
    <message>
        <source>as it lies</source>
        <translation>in vorhandener Lage</translation>
    </message>
    <message>
        <source>ball artefact</source>
        <translation>Kugelnormal</translation>
    </message>
    <message>
        <source>change of the room temperature</source>
        <translation>Änderung der Raumtemperatur</translation>
    </message>
    <message>
        <source>coolant minus structure temperature</source>
        <translation>Kühlschmierstoff- minus Strukturtemperatur</translation>
    </message>
    <message>
        <source>distance {} along {}</source>
        <translation>Abstand {} entlang {}</translation>
    </message>
    <message>
        <source>excess temperature where the nut travels</source>
        <translation>Übertemperatur im Verfahrbereich der Mutter</translation>
    </message>
    <message>
        <source>exercise {}, {}</source>
        <translation>Übung {}, {}</translation>
    </message>
    <message>
        <source>fiducial plate</source>
        <translation>Messmarkenplatte</translation>
    </message>
    <message>
        <source>finite numbers</source>
        <translation>endliche Zahlen</translation>
    </message>
    <message>
        <source>greater than zero</source>
        <translation>größer als null</translation>
    </message>
    <message>
        <source>half of the reversal error</source>
        <translation>halbe Umkehrspanne</translation>
    </message>
    <message>
        <source>has a size that is not a number from 0 on</source>
        <translation>hat eine Größe, die keine Zahl ab 0 ist</translation>
    </message>
    <message>
        <source>has more than three parts</source>
        <translation>hat mehr als drei Teile</translation>
    </message>
    <message>
        <source>hint {}; allowed: 1 to {}.</source>
        <translation>Hinweis {}; zulässig: 1 bis {}.</translation>
    </message>
    <message>
        <source>hole bar</source>
        <translation>Lochleiste</translation>
    </message>
    <message>
        <source>level &quot;{}&quot; is not known; allowed: easy, medium or hard.</source>
        <translation>Stufe „{}“ ist nicht bekannt; zulässig: easy, medium oder hard.</translation>
    </message>
    <message>
        <source>machine &quot;{}&quot; has no axis {}; a test piece is milled with X, Y and Z.</source>
        <translation>Maschine „{}“ hat keine Achse {}; ein Prüfwerkstück wird mit X, Y und Z gefräst.</translation>
    </message>
    <message>
        <source>machine &quot;{}&quot; has {:g} mm x {:g} mm of travel in X and Y; a test piece needs 45 mm in each at least.</source>
        <translation>Maschine „{}“ hat {:g} mm x {:g} mm Verfahrweg in X und Y; ein Prüfwerkstück braucht jeweils mindestens 45 mm.</translation>
    </message>
    <message>
        <source>names no effect</source>
        <translation>nennt keinen Effekt</translation>
    </message>
    <message>
        <source>not named</source>
        <translation>nicht benannt</translation>
    </message>
    <message>
        <source>of hole {}</source>
        <translation>der Bohrung {}</translation>
    </message>
    <message>
        <source>of inclined face {}</source>
        <translation>der geneigten Fläche {}</translation>
    </message>
    <message>
        <source>of side {}</source>
        <translation>der Seite {}</translation>
    </message>
    <message>
        <source>of the centre bore</source>
        <translation>der Mittelbohrung</translation>
    </message>
    <message>
        <source>of the circle</source>
        <translation>des Kreises</translation>
    </message>
    <message>
        <source>of the holes</source>
        <translation>der Bohrungen</translation>
    </message>
    <message>
        <source>of the square</source>
        <translation>des Quadrats</translation>
    </message>
    <message>
        <source>part of the warm-up that has passed</source>
        <translation>abgelaufener Anteil des Warmlaufs</translation>
    </message>
    <message>
        <source>seed {} is not allowed; allowed: 0 to {}.</source>
        <translation>Startwert {} ist nicht zulässig; zulässig: 0 bis {}.</translation>
    </message>
    <message>
        <source>size {} along {}</source>
        <translation>Maß {} entlang {}</translation>
    </message>
    <message>
        <source>slip along X</source>
        <translation>Rutschen entlang X</translation>
    </message>
    <message>
        <source>spindle heat times distance from where it does nothing</source>
        <translation>Spindelwärme mal Abstand von der Stelle ohne Wirkung</translation>
    </message>
    <message>
        <source>square of the spindle speed</source>
        <translation>Quadrat der Spindeldrehzahl</translation>
    </message>
    <message>
        <source>temperature difference across the frame</source>
        <translation>Temperaturdifferenz über das Gestell</translation>
    </message>
    <message>
        <source>temperature difference across the guideway of Y</source>
        <translation>Temperaturdifferenz über die Führung von Y</translation>
    </message>
    <message>
        <source>temperature difference across the head</source>
        <translation>Temperaturdifferenz über den Spindelkopf</translation>
    </message>
    <message>
        <source>temperature difference bottom minus top of the beam</source>
        <translation>Temperaturdifferenz unten minus oben am Querbalken</translation>
    </message>
    <message>
        <source>temperature difference front minus rear of the column</source>
        <translation>Temperaturdifferenz vorn minus hinten am Ständer</translation>
    </message>
    <message>
        <source>temperature difference left minus right of the column</source>
        <translation>Temperaturdifferenz links minus rechts am Ständer</translation>
    </message>
    <message>
        <source>temperature difference that the heat makes across the column</source>
        <translation>durch die Wärme verursachte Temperaturdifferenz über den Ständer</translation>
    </message>
    <message>
        <source>temperature rise of the artefact</source>
        <translation>Temperaturanstieg des Prüfkörpers</translation>
    </message>
    <message>
        <source>temperature rise of the ball screw</source>
        <translation>Temperaturanstieg des Kugelgewindetriebs</translation>
    </message>
    <message>
        <source>temperature rise of the column</source>
        <translation>Temperaturanstieg des Ständers</translation>
    </message>
    <message>
        <source>temperature rise of the part that is heated</source>
        <translation>Temperaturanstieg des erwärmten Teils</translation>
    </message>
    <message>
        <source>temperature rise of the scale</source>
        <translation>Temperaturanstieg des Maßstabs</translation>
    </message>
    <message>
        <source>temperature rise of the spindle</source>
        <translation>Temperaturanstieg der Spindel</translation>
    </message>
    <message>
        <source>temperature rise of the table</source>
        <translation>Temperaturanstieg des Tisches</translation>
    </message>
    <message>
        <source>temperature rise of the table drive</source>
        <translation>Temperaturanstieg des Tischantriebs</translation>
    </message>
    <message>
        <source>test part: {} = {:g}; allowed: {}.</source>
        <translation>Prüfwerkstück: {} = {:g}; zulässig: {}.</translation>
    </message>
    <message>
        <source>those that what-if --list lists</source>
        <translation>die von what-if --list aufgelisteten</translation>
    </message>
    <message>
        <source>version {} is not known; allowed: 1.</source>
        <translation>Version {} ist nicht bekannt; zulässig: 1.</translation>
    </message>
    <message>
        <source>{} = {}; allowed: a finite number.</source>
        <translation>{} = {}; zulässig: eine endliche Zahl.</translation>
    </message>
    <message>
        <source>{} hints; allowed: 0 to {}.</source>
        <translation>{} Hinweise; zulässig: 0 bis {}.</translation>
    </message>
    <message>
        <source>{} is negative; allowed: 0 and more.</source>
        <translation>{} ist negativ; zulässig: 0 und mehr.</translation>
    </message>
    <message>
        <source>{} named, which is nested with it</source>
        <translation>{} benannt, eines ist im anderen eingebettet</translation>
    </message>
    <message>
        <source>{} of the diamond</source>
        <translation>{} der Raute</translation>
    </message>
    <message>
        <source>{} of the square</source>
        <translation>{} des Quadrats</translation>
    </message>
    <message>
        <source>{} {} to {}</source>
        <translation>{} {} zu {}</translation>
    </message>
    <message>
        <source>{}, least squares</source>
        <translation>{}, kleinste Quadrate</translation>
    </message>
    <message>
        <source>Captures</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>Compensation</source>
        <translation>Kompensation</translation>
    </message>
    <message>
        <source>Compensation over the log</source>
        <translation>Kompensation über das Protokoll</translation>
    </message>
    <message>
        <source>Events</source>
        <translation>Ereignisse</translation>
    </message>
    <message>
        <source>ISO 230-3: environmental temperature variation error</source>
        <translation>ISO 230-3: Abweichung durch Änderung der Umgebungstemperatur</translation>
    </message>
    <message>
        <source>ISO 230-3: thermal distortion caused by the rotating spindle</source>
        <translation>ISO 230-3: thermische Verlagerung durch die drehende Spindel</translation>
    </message>
    <message>
        <source>Laser profiler</source>
        <translation>Laser-Profilsensor</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Measured with: {}</source>
        <translation>Gemessen mit: {}</translation>
    </message>
    <message>
        <source>Measurement plan</source>
        <translation>Messplan</translation>
    </message>
    <message>
        <source>Microscope and coded fiducials</source>
        <translation>Mikroskop und codierte Messmarken</translation>
    </message>
    <message>
        <source>Model over time</source>
        <translation>Modell über der Zeit</translation>
    </message>
    <message>
        <source>Notes</source>
        <translation>Notizen</translation>
    </message>
    <message>
        <source>Observations</source>
        <translation>Beobachtungen</translation>
    </message>
    <message>
        <source>Operating conditions</source>
        <translation>Betriebsbedingungen</translation>
    </message>
    <message>
        <source>Provenance</source>
        <translation>Herkunft</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>State of the instrument</source>
        <translation>Zustand des Messgeräts</translation>
    </message>
    <message>
        <source>Summary</source>
        <translation>Zusammenfassung</translation>
    </message>
    <message>
        <source>Taken out by the user</source>
        <translation>Vom Anwender ausgeschlossen</translation>
    </message>
    <message>
        <source>The search is done.</source>
        <translation>Die Suche ist abgeschlossen.</translation>
    </message>
    <message>
        <source>The thermal drift of the machine and a drift of the instrument cannot be separated here, because {}; {}.</source>
        <translation>Die thermische Drift der Maschine und eine Drift des Messgeräts sind hier nicht trennbar, weil {}; {}.</translation>
    </message>
    <message>
        <source>Thermal error of the table</source>
        <translation>Thermische Abweichung des Tisches</translation>
    </message>
    <message>
        <source>Touch probe</source>
        <translation>Messtaster</translation>
    </message>
    <message>
        <source>Trends</source>
        <translation>Verläufe</translation>
    </message>
    <message>
        <source>Verification</source>
        <translation>Verifizierung</translation>
    </message>
    <message>
        <source>What happened</source>
        <translation>Ereignisse</translation>
    </message>
    <message>
        <source>{} of {} has {}{}, {:.2f} {} rms</source>
        <translation>{} von {} hat {}{}, {:.2f} {} rms</translation>
    </message>
    <message>
        <source>angular error of the {} axis about {}</source>
        <translation>Winkelabweichung der {}-Achse um {}</translation>
    </message>
    <message>
        <source>column tilt about {}</source>
        <translation>Neigung des Ständers um {}</translation>
    </message>
    <message>
        <source>crash</source>
        <translation>Kollision</translation>
    </message>
    <message>
        <source>displacement of the table along X</source>
        <translation>Verschiebung des Tisches entlang X</translation>
    </message>
    <message>
        <source>displacement of the table along Y</source>
        <translation>Verschiebung des Tisches entlang Y</translation>
    </message>
    <message>
        <source>displacement of the table along Z</source>
        <translation>Verschiebung des Tisches entlang Z</translation>
    </message>
    <message>
        <source>head tilt about {}</source>
        <translation>Neigung des Spindelkopfs um {}</translation>
    </message>
    <message>
        <source>moved</source>
        <translation>umgestellt</translation>
    </message>
    <message>
        <source>note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>positioning error of the X axis per metre, from the centre of the rotary axis</source>
        <translation>Positionierabweichung der X-Achse je Meter, ab der Mitte der Drehachse</translation>
    </message>
    <message>
        <source>positioning error of the {} axis</source>
        <translation>Positionierabweichung der {}-Achse</translation>
    </message>
    <message>
        <source>radial expansion of the table at the reference hole</source>
        <translation>radiale Ausdehnung des Tisches an der Referenzbohrung</translation>
    </message>
    <message>
        <source>re-levelled</source>
        <translation>neu ausgerichtet</translation>
    </message>
    <message>
        <source>repair</source>
        <translation>Reparatur</translation>
    </message>
    <message>
        <source>roll error of the {} axis</source>
        <translation>Rollabweichung der {}-Achse</translation>
    </message>
    <message>
        <source>rotation</source>
        <translation>Drehung</translation>
    </message>
    <message>
        <source>rotation of the table about X</source>
        <translation>Drehung des Tisches um X</translation>
    </message>
    <message>
        <source>rotation of the table about Y</source>
        <translation>Drehung des Tisches um Y</translation>
    </message>
    <message>
        <source>rotation of the table about Z</source>
        <translation>Drehung des Tisches um Z</translation>
    </message>
    <message>
        <source>squareness of Y to X</source>
        <translation>Rechtwinkligkeitsabweichung von Y zu X</translation>
    </message>
    <message>
        <source>squareness of Z to X</source>
        <translation>Rechtwinkligkeitsabweichung von Z zu X</translation>
    </message>
    <message>
        <source>squareness of Z to Y</source>
        <translation>Rechtwinkligkeitsabweichung von Z zu Y</translation>
    </message>
    <message>
        <source>straightness error of the {} axis in the direction of {}</source>
        <translation>Geradheitsabweichung der {}-Achse in Richtung {}</translation>
    </message>
    <message>
        <source>thermal displacement of the spindle along {}</source>
        <translation>thermische Verlagerung der Spindel entlang {}</translation>
    </message>
    <message>
        <source>thermal expansion of the artefact per metre, from its reference hole</source>
        <translation>thermische Ausdehnung des Prüfkörpers je Meter, ab seiner Referenzbohrung</translation>
    </message>
    <message>
        <source>thermal expansion of the {} ball screw from its fixed bearing</source>
        <translation>thermische Ausdehnung des {}-Kugelgewindetriebs ab seinem Festlager</translation>
    </message>
    <message>
        <source>tilt</source>
        <translation>Neigung</translation>
    </message>
    <message>
        <source>Signatures</source>
        <translation>Unterschriften</translation>
    </message>
    <message>
        <source>Where simulation and measurement disagree</source>
        <translation>Wo Simulation und Messung voneinander abweichen</translation>
    </message>
    <message>
        <source>variance {} of row {} is not allowed; allowed: greater than zero.</source>
        <translation>Die Varianz {} der Zeile {} ist nicht erlaubt; erlaubt: größer als null.</translation>
    </message>
    <message>
        <source>a list of at least {} entries</source>
        <translation>eine Liste mit mindestens {} Einträgen</translation>
    </message>
    <message>
        <source>a row from 0 to {}</source>
        <translation>eine Zeile von 0 bis {}</translation>
    </message>
    <message>
        <source>positioning error of the {} axis per metre</source>
        <translation>Positionierabweichung der {}-Achse je Meter</translation>
    </message>
    <message>
        <source>rms {:.3f} before, {:.3f} after ({:.0f} % {}) on rows not used for fitting,</source>
        <translation>rms {:.3f} vorher, {:.3f} nachher ({:.0f} % {}) auf nicht zur Anpassung verwendeten Zeilen,</translation>
    </message>
    <message>
        <source> {} now in the folder &quot;removed&quot;.</source>
        <translation> {} jetzt im Ordner „removed“.</translation>
    </message>
    <message>
        <source> {} removed.</source>
        <translation> {} entfernt.</translation>
    </message>
    <message>
        <source>1 capture</source>
        <translation>1 Aufnahme</translation>
    </message>
    <message>
        <source>1 interruption</source>
        <translation>1 Unterbrechung</translation>
    </message>
    <message>
        <source>1 measuring cycle</source>
        <translation>1 Messzyklus</translation>
    </message>
    <message>
        <source>1 point is</source>
        <translation>1 Punkt ist</translation>
    </message>
    <message>
        <source>1 touch is</source>
        <translation>1 Antastung ist</translation>
    </message>
    <message>
        <source>1 unfinished campaign is</source>
        <translation>1 unfertige Kampagne ist</translation>
    </message>
    <message>
        <source>1 unfinished file was</source>
        <translation>1 unfertige Datei wurde</translation>
    </message>
    <message>
        <source>largest deviation {} is {} at {}</source>
        <translation>die größte Abweichung {} beträgt {} bei {}</translation>
    </message>
    <message>
        <source>rms of {} is {}</source>
        <translation>rms von {} beträgt {}</translation>
    </message>
    <message>
        <source>{} captures</source>
        <translation>{} Aufnahmen</translation>
    </message>
    <message>
        <source>{} interruptions</source>
        <translation>{} Unterbrechungen</translation>
    </message>
    <message>
        <source>{} measuring cycles</source>
        <translation>{} Messzyklen</translation>
    </message>
    <message>
        <source>{} points are</source>
        <translation>{} Punkte sind</translation>
    </message>
    <message>
        <source>{} touches are</source>
        <translation>{} Antastungen sind</translation>
    </message>
    <message>
        <source>{} unfinished campaigns are</source>
        <translation>{} unfertige Kampagnen sind</translation>
    </message>
    <message>
        <source>{} unfinished files were</source>
        <translation>{} unfertige Dateien wurden</translation>
    </message>
    <message>
        <source>the notes</source>
        <translation>die Notizen</translation>
    </message>
    <message>
        <source>reasons of exclusions</source>
        <translation>Gründe von Ausschlüssen</translation>
    </message>
    <message>
        <source>the measurement plan</source>
        <translation>der Messplan</translation>
    </message>
    <message>
        <source>{} of {} measurements were more than {:.0f} standard uncertainties off the prediction and were not used, the first at {:.6g} s ({:.2f} off); a second one in a row on the same side would have been.</source>
        <translation>{} von {} Messungen lagen mehr als {:.0f} Standardunsicherheiten neben der Vorhersage und wurden nicht verwendet, die erste bei {:.6g} s (um {:.2f}); eine zweite in Folge auf derselben Seite wäre verwendet worden.</translation>
    </message>
    <message>
        <source>0, 1 or 2</source>
        <translation>0, 1 oder 2</translation>
    </message>
    <message>
        <source>The column {} of the log was left out: &quot;{}&quot; in line {} and {} more of its fields are no numbers.</source>
        <translation>Die Spalte {} des Protokolls wurde weggelassen: „{}“ in Zeile {} und {} weitere ihrer Felder sind keine Zahlen.</translation>
    </message>
    <message>
        <source>a model of one output</source>
        <translation>ein Modell eines Ausgangs</translation>
    </message>
    <message>
        <source>a number of cycles</source>
        <translation>eine Anzahl von Zyklen</translation>
    </message>
    <message>
        <source>no model before the log has a row</source>
        <translation>kein Modell, bevor das Protokoll eine Zeile hat</translation>
    </message>
    <message>
        <source>the file has {} bytes; at most {} are allowed.</source>
        <translation>die Datei hat {} Bytes; höchstens {} sind zulässig.</translation>
    </message>
    <message>
        <source>the name of the point &quot;{}&quot; cannot stand in a programme; allowed: letters, digits, _, - and .</source>
        <translation>der Name des Punkts „{}“ kann nicht in einem Programm stehen; zulässig: Buchstaben, Ziffern, _, - und .</translation>
    </message>
    <message>
        <source>the stored discrepancy holds lists of unequal length for {} of {}; search again.</source>
        <translation>die gespeicherte Diskrepanz enthält für {} von {} Listen ungleicher Länge; erneut suchen.</translation>
    </message>
    <message>
        <source>the stored evaluation cannot be read ({}); evaluate again.</source>
        <translation>die gespeicherte Auswertung kann nicht gelesen werden ({}); erneut auswerten.</translation>
    </message>
    <message>
        <source>the time offset of {} cannot be read ({}).</source>
        <translation>der Zeitversatz von {} kann nicht gelesen werden ({}).</translation>
    </message>
    <message>
        <source>gives more bytes than are allowed; allowed: at most {}.</source>
        <translation>liefert mehr Bytes, als zulässig sind; zulässig: höchstens {}.</translation>
    </message>
    <message>
        <source>Not checked: a drift of the instrument would appear in every deviation as a motion of the machine.</source>
        <translation>Nicht geprüft: Eine Drift des Messgeräts würde in jeder Abweichung als Bewegung der Maschine erscheinen.</translation>
    </message>
    <message>
        <source>No motion under the scan model {} explains {} of {} scans: the surface has changed its shape, by {:.2g} µm rms in {} {}. The change is found as a free-form field beside the motion; the part that a motion could explain as well is in the uncertainty of the deviations (in that scan ± {:.2g} µm).</source>
        <translation>Keine Bewegung nach dem Scanmodell {} erklärt {} von {} Scans: Die Oberfläche hat ihre Form geändert, um {:.2g} µm rms bei {} {}. Die Änderung wird als Freiformfeld neben der Bewegung bestimmt; der Teil, den auch eine Bewegung erklären könnte, steckt in der Unsicherheit der Abweichungen (bei diesem Scan ± {:.2g} µm).</translation>
    </message>
    <message>
        <source>the surface has changed its shape, which leaves it uncertain by {:.0f} {}.</source>
        <translation>die Fläche hat ihre Form geändert; dadurch ist die Komponente nur auf {:.0f} {} bekannt.</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>five</source>
        <translation>fünf</translation>
    </message>
    <message>
        <source>focus</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source>four</source>
        <translation>vier</translation>
    </message>
    <message>
        <source>one</source>
        <translation>ein</translation>
    </message>
    <message>
        <source>or</source>
        <translation>oder</translation>
    </message>
    <message>
        <source>second order in {}</source>
        <translation>zweite Ordnung in {}</translation>
    </message>
    <message>
        <source>spindle changed</source>
        <translation>Spindel gewechselt</translation>
    </message>
    <message>
        <source>state {} cannot be compensated: {}. The nine-parameter model needs at least three points that are not on one line.</source>
        <translation>Zustand {} kann nicht kompensiert werden: {}. Das Neun-Parameter-Modell braucht mindestens drei Punkte, die nicht auf einer Geraden liegen.</translation>
    </message>
    <message>
        <source>third order in {}</source>
        <translation>dritte Ordnung in {}</translation>
    </message>
    <message>
        <source>three</source>
        <translation>drei</translation>
    </message>
    <message>
        <source>turned by 90°</source>
        <translation>um 90° gedreht</translation>
    </message>
    <message>
        <source>two</source>
        <translation>zwei</translation>
    </message>
    <message>
        <source>{} has none of the {} {} images it needs in {}</source>
        <translation>{0} hat keines der {1} nötigen Bilder ({2}) in {3}</translation>
    </message>
    <message>
        <source>{} has only {} of the {} {} images it needs in {}</source>
        <translation>{0} hat nur {1} der {2} nötigen Bilder ({3}) in {4}</translation>
    </message>
    <message>
        <source>{}, {} {}: x {:g}, y {:g}, z {:g} mm, spindle {:g}°</source>
        <translation>{}, {} {}: x {:g}, y {:g}, z {:g} mm, Spindel {:g}°</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>simulation</source>
        <translation>Simulation</translation>
    </message>
    <message>
        <source>{}, already named, would explain it equally well with a separate time history</source>
        <translation>{}, bereits benannt, würde es mit einem eigenen Zeitverlauf ebenso gut erklären</translation>
    </message>
    <message>
        <source>the model has no output to compensate.</source>
        <translation>das Modell hat keine Ausgangsgröße, die kompensiert werden könnte.</translation>
    </message>
    <message>
        <source>the log has no column {} that the model is of.</source>
        <translation>das Protokoll hat keine Spalte {}, zu der das Modell gehört.</translation>
    </message>
    <message>
        <source>Choose the campaign that was measured with the compensation on first.</source>
        <translation>Zuerst die Kampagne wählen, die mit eingeschalteter Kompensation gemessen wurde.</translation>
    </message>
    <message>
        <source>The touches make up no whole cycle.</source>
        <translation>Die Antastungen ergeben keinen vollständigen Zyklus.</translation>
    </message>
    <message>
        <source>lists no touches.</source>
        <translation>führt keine Antastungen auf.</translation>
    </message>
    <message>
        <source>the log has a single row.</source>
        <translation>das Protokoll hat nur eine Zeile.</translation>
    </message>
    <message>
        <source>the result of {} was not kept.</source>
        <translation>das Ergebnis von {} wurde nicht behalten.</translation>
    </message>
    <message>
        <source>{} is no task of a campaign.</source>
        <translation>{} ist keine Aufgabe einer Kampagne.</translation>
    </message>
    <message>
        <source>An expansion of {:g} µm/(m·K) is below that of any glass ceramic. Steel has 11.5, Invar 1.2.</source>
        <translation>Eine Ausdehnung von {:g} µm/(m·K) liegt unter der jeder Glaskeramik. Stahl hat 11,5, Invar 1,2.</translation>
    </message>
    <message>
        <source>The plate rises by {:.2f} mrad along the scan, which the scan model push broom cannot explain: the plate is not level, or the scan is rigid.</source>
        <translation>Die Platte steigt entlang des Scans um {:.2f} mrad an, was das zeilenweise Scanmodell nicht erklären kann: Die Platte liegt nicht eben, oder der Scan ist starr.</translation>
    </message>
    <message>
        <source>push broom</source>
        <translation>zeilenweise</translation>
    </message>
    <message>
        <source>{} = {}, before {}</source>
        <translation>{} = {}, vorher {}</translation>
    </message>
    <message>
        <source>α about X</source>
        <translation>α um X</translation>
    </message>
    <message>
        <source>β about Y</source>
        <translation>β um Y</translation>
    </message>
    <message>
        <source>γ about Z</source>
        <translation>γ um Z</translation>
    </message>
    <message>
        <source>is not valid JSON here: the byte 0x{:02X} is not UTF-8 (Latin-1, perhaps); allowed: JSON in UTF-8.</source>
        <translation>ist hier kein gültiges JSON: das Byte 0x{:02X} ist kein UTF-8 (vielleicht Latin-1); zulässig: JSON in UTF-8.</translation>
    </message>
    <message>
        <source>{} is a straight line: its points determine no surface.</source>
        <translation>{} ist eine gerade Linie: ihre Punkte bestimmen keine Fläche.</translation>
    </message>
    <message>
        <source>{} is {:.4g} wide, which is implausible in mm: the unit seems to be µm; allowed: mm.</source>
        <translation>{} ist {:.4g} breit, was in mm unplausibel ist: die Einheit ist anscheinend µm; zulässig: mm.</translation>
    </message>
    <message>
        <source>{} scatters {:.{}f} times as much as its stated sigma; it is used as found.</source>
        <translation>{} streut {:.{}f}-mal so stark wie das angegebene sigma; verwendet wird die gefundene Streuung.</translation>
    </message>
    <message>
        <source>The observations agree far better with the simulation of about {:.0f} min {} ({:.0f} % less scatter), so they are compared with simulation and log at that time: compare the clocks of observations.csv, log.csv and the simulation.</source>
        <translation>Die Beobachtungen stimmen weit besser mit der Simulation von etwa {:.0f} min {} überein ({:.0f} % weniger Streuung) und werden deshalb mit Simulation und Protokoll zu dieser Zeit verglichen: Uhren von observations.csv, log.csv und der Simulation vergleichen.</translation>
    </message>
    <message>
        <source>What is named fits the log as if its clock were about {:.0f} min {} that of the observations, and is told with it: compare the clocks.</source>
        <translation>Was genannt ist, passt zum Protokoll, als ginge dessen Uhr etwa {:.0f} min {} der Uhr der Beobachtungen, und wird damit angegeben: Uhren vergleichen.</translation>
    </message>
    <message>
        <source>No point was measured in more than one state.</source>
        <translation>Kein Punkt wurde in mehr als einem Zustand gemessen.</translation>
    </message>
    <message>
        <source>Not passed: {}.</source>
        <translation>Nicht bestanden: {}.</translation>
    </message>
    <message>
        <source>Passed: all differences stay within {} times the resolution of their axis.</source>
        <translation>Bestanden: alle Differenzen bleiben innerhalb des {}-Fachen der Auflösung ihrer Achse.</translation>
    </message>
    <message>
        <source>There is only one state: nothing to compare.</source>
        <translation>Es gibt nur einen Zustand: nichts zu vergleichen.</translation>
    </message>
    <message>
        <source>There is no simulator to search with: campaign.json names none and none was chosen (Discrepancy).</source>
        <translation>Es gibt keinen Simulator, mit dem gesucht werden kann: campaign.json nennt keinen, und es wurde keiner gewählt (Diskrepanz).</translation>
    </message>
    <message>
        <source>the simulator</source>
        <translation>der Simulator</translation>
    </message>
    <message>
        <source>the stored check cannot be read ({}); check again.</source>
        <translation>die gespeicherte Prüfung ist nicht lesbar ({}); erneut prüfen.</translation>
    </message>
    <message>
        <source>{} failed: {}</source>
        <translation>{} ist fehlgeschlagen: {}</translation>
    </message>
    <message>
        <source>(ex, ey, ez) = (gx, gy, gz) q, of one point</source>
        <translation>(ex, ey, ez) = (gx, gy, gz) q, an einem Punkt</translation>
    </message>
    <message>
        <source>ex = g q (z - z0)^2 / 2, EB = g q (z - z0), ez = -EB rx</source>
        <translation>ex = g q (z - z0)^2 / 2, EB = g q (z - z0), ez = -EB rx</translation>
    </message>
    <message>
        <source>ey = -g q (z - z0)^2 / 2, EA = g q (z - z0), ez = EA ry</source>
        <translation>ey = -g q (z - z0)^2 / 2, EA = g q (z - z0), ez = EA ry</translation>
    </message>
    <message>
        <source>ez = g n^2, n the spindle speed</source>
        <translation>ez = g n^2, n die Spindeldrehzahl</translation>
    </message>
    <message>
        <source>e{} = g d, d = +1 or -1 by the side of the approach</source>
        <translation>e{} = g d, d = +1 oder -1 je nach Anfahrseite</translation>
    </message>
    <message>
        <source>feed %1</source>
        <translation>Vorschub %1</translation>
    </message>
    <message>
        <source>first-order time constant</source>
        <translation>Zeitkonstante erster Ordnung</translation>
    </message>
    <message>
        <source>first-order time constant, another one while it cools</source>
        <translation>Zeitkonstante erster Ordnung, beim Abkühlen eine andere</translation>
    </message>
    <message>
        <source>instrument switched on</source>
        <translation>Messgerät eingeschaltet</translation>
    </message>
    <message>
        <source>instrument switched on (assumed)</source>
        <translation>Messgerät eingeschaltet (angenommen)</translation>
    </message>
    <message>
        <source>position %1</source>
        <translation>Position %1</translation>
    </message>
    <message>
        <source>pulse at an unknown time</source>
        <translation>Puls zu unbekannter Zeit</translation>
    </message>
    <message>
        <source>speed %1</source>
        <translation>Drehzahl %1</translation>
    </message>
    <message>
        <source>spindle speed</source>
        <translation>Spindeldrehzahl</translation>
    </message>
    <message>
        <source>step at an unknown time</source>
        <translation>Sprung zu unbekannter Zeit</translation>
    </message>
    <message>
        <source>temperature of %1</source>
        <translation>Temperatur %1</translation>
    </message>
    <message>
        <source>time constant</source>
        <translation>Zeitkonstante</translation>
    </message>
    <message>
        <source>none (follows at once)</source>
        <translation>keine (folgt sofort)</translation>
    </message>
    <message>
        <source>E{0} was not measured: no correction of {0} is stated, and there is no screw compensation for it.</source>
        <translation>E{0} wurde nicht gemessen: Für {0} wird keine Korrektur angegeben, und es gibt dafür keine Spindelsteigungskompensation.</translation>
    </message>
    <message>
        <source>a number from -1 to 1</source>
        <translation>eine Zahl von -1 bis 1</translation>
    </message>
    <message>
        <source>a number from {:g} to {:g}</source>
        <translation>eine Zahl von {:g} bis {:g}</translation>
    </message>
    <message>
        <source>a position to be kept is listed twice; allowed: each once.</source>
        <translation>Eine beizubehaltende Position ist doppelt angegeben; erlaubt: jede einmal.</translation>
    </message>
    <message>
        <source>The expansion coefficient of {} is not stated: its lengths against the certificate are not corrected for {:.1f} K.</source>
        <translation>Der Ausdehnungskoeffizient von {} ist nicht angegeben: Seine Längen gegen den Kalibrierschein sind nicht um {:.1f} K korrigiert.</translation>
    </message>
    <message>
        <source>The log has no spindle speed: that the machine was at rest could not be checked.</source>
        <translation>Das Protokoll enthält keine Spindeldrehzahl: Ob die Maschine stillstand, konnte nicht geprüft werden.</translation>
    </message>
    <message>
        <source>The machine file states no uncertainty of {} of {}: taken as exact, though lengths were corrected by up to {:.1f} µm/m.</source>
        <translation>Die Maschinendatei nennt keine Unsicherheit für {} von {}: als exakt angenommen, obwohl Längen um bis zu {:.1f} µm/m korrigiert wurden.</translation>
    </message>
    <message>
        <source>{} is {:g} at {:g} s: an ETVE test is of a machine at rest, and what its axes heat counts as environment.</source>
        <translation>{} ist {:g} bei {:g} s: Eine ETVE-Prüfung gilt einer ruhenden Maschine, und was ihre Achsen erwärmen, zählt als Umgebung.</translation>
    </message>
    <message>
        <source>{} {} is not allowed; allowed: {:g} to {:g} mm/min.</source>
        <translation>{} {} ist nicht erlaubt; zulässig: {:g} bis {:g} mm/min.</translation>
    </message>
    <message>
        <source>{}{:g} is not known here</source>
        <translation>{}{:g} ist hier nicht bekannt</translation>
    </message>
    <message>
        <source>The options ask for something that this version of the library does not know; allowed: 0 there.</source>
        <translation>Die Optionen verlangen etwas, das diese Version der Bibliothek nicht kennt; erlaubt: dort 0.</translation>
    </message>
    <message>
        <source>The virtual profiler takes more than a million points per mm; allowed: fewer points in a profile or profiles further apart.</source>
        <translation>Der virtuelle Profilsensor nimmt mehr als eine Million Punkte je mm auf; erlaubt: weniger Punkte im Profil oder größere Profilabstände.</translation>
    </message>
    <message>
        <source>Calculating the compensation</source>
        <translation>Kompensation wird berechnet</translation>
    </message>
    <message>
        <source>Checking the captures</source>
        <translation>Aufnahmen werden geprüft</translation>
    </message>
    <message>
        <source>Checking the jogs</source>
        <translation>Verfahrschritte werden geprüft</translation>
    </message>
    <message>
        <source>Checking the repeatability</source>
        <translation>Wiederholgenauigkeit wird geprüft</translation>
    </message>
    <message>
        <source>Checking the scans</source>
        <translation>Scans werden geprüft</translation>
    </message>
    <message>
        <source>Checking the touches</source>
        <translation>Antastungen werden geprüft</translation>
    </message>
    <message>
        <source>Comparing before and after</source>
        <translation>Vorher und nachher werden verglichen</translation>
    </message>
    <message>
        <source>Evaluating the captures</source>
        <translation>Aufnahmen werden ausgewertet</translation>
    </message>
    <message>
        <source>Evaluating the scans</source>
        <translation>Scans werden ausgewertet</translation>
    </message>
    <message>
        <source>Evaluating the touches</source>
        <translation>Antastungen werden ausgewertet</translation>
    </message>
    <message>
        <source>Finding the six errors</source>
        <translation>Sechs Abweichungen werden bestimmt</translation>
    </message>
    <message>
        <source>Fitting all cycles</source>
        <translation>Alle Zyklen werden angepasst</translation>
    </message>
    <message>
        <source>Fitting the nine-parameter model</source>
        <translation>Das Neun-Parameter-Modell wird angepasst</translation>
    </message>
    <message>
        <source>Identifying the model</source>
        <translation>Modell wird identifiziert</translation>
    </message>
    <message>
        <source>Running the compensator</source>
        <translation>Der Kompensator läuft</translation>
    </message>
    <message>
        <source>Searching for what the simulation lacks</source>
        <translation>Suche nach dem, was in der Simulation fehlt</translation>
    </message>
    <message>
        <source>Searching with the simulator</source>
        <translation>Suche mit dem Simulator</translation>
    </message>
    <message>
        <source>The captures checked here can be used; those of other instruments are judged when they are evaluated.</source>
        <translation>Die hier geprüften Aufnahmen sind verwendbar; die der anderen Messgeräte werden bei ihrer Auswertung beurteilt.</translation>
    </message>
    <message>
        <source>The file of the report is gone. Write it again.</source>
        <translation>Die Datei des Berichts fehlt. Den Bericht neu schreiben.</translation>
    </message>
    <message>
        <source>Writing the report</source>
        <translation>Der Bericht wird geschrieben</translation>
    </message>
    <message>
        <source>the check of the jogs</source>
        <translation>die Prüfung der Verfahrschritte</translation>
    </message>
    <message>
        <source>the check of the repeatability</source>
        <translation>die Prüfung der Wiederholgenauigkeit</translation>
    </message>
    <message>
        <source>the comparison of before and after</source>
        <translation>der Vergleich von vorher und nachher</translation>
    </message>
    <message>
        <source>the compensation</source>
        <translation>die Kompensation</translation>
    </message>
    <message>
        <source>the compensation over the log</source>
        <translation>die Kompensation über das Protokoll</translation>
    </message>
    <message>
        <source>the search with the simulator</source>
        <translation>die Suche mit dem Simulator</translation>
    </message>
    <message>
        <source>Amplitude of the surface</source>
        <translation>Amplitude der Fläche</translation>
    </message>
    <message>
        <source>Height of a bump</source>
        <translation>Höhe eines Höckers</translation>
    </message>
    <message>
        <source>Noise of the profiler: found {} µm; allowed: {:g} to {:g}.</source>
        <translation>Rauschen des Profilsensors: gefunden {} µm; zulässig: {:g} bis {:g}.</translation>
    </message>
    <message>
        <source>Number of points of a scan: found {}; allowed: 100 to {:g}.</source>
        <translation>Anzahl der Punkte eines Scans: gefunden {}; zulässig: 100 bis {:g}.</translation>
    </message>
    <message>
        <source>Place of a bump</source>
        <translation>Ort eines Höckers</translation>
    </message>
    <message>
        <source>Radius of a bump</source>
        <translation>Radius eines Höckers</translation>
    </message>
    <message>
        <source>Size of the artefact in x</source>
        <translation>Größe des Prüfkörpers in x</translation>
    </message>
    <message>
        <source>Size of the artefact in y</source>
        <translation>Größe des Prüfkörpers in y</translation>
    </message>
    <message>
        <source>Wave number of the surface</source>
        <translation>Wellenzahl der Fläche</translation>
    </message>
    <message>
        <source>{}: found {} {}; allowed: {:g} to {:g}.</source>
        <translation>{}: gefunden {} {}; zulässig: {:g} bis {:g}.</translation>
    </message>
    <message>
        <source>Point {} was measured fewer than {} times: too few to see a drift.</source>
        <translation>Punkt {} wurde weniger als {}-mal gemessen: zu selten, um eine Drift zu sehen.</translation>
    </message>
    <message>
        <source>Settled: the drift of every axis is below {} µm/h with its uncertainty.</source>
        <translation>Eingelaufen: die Drift jeder Achse liegt mit ihrer Unsicherheit unter {} µm/h.</translation>
    </message>
    <message>
        <source>Checking whether the instrument had settled</source>
        <translation>Es wird geprüft, ob das Messgerät eingelaufen war</translation>
    </message>
    <message>
        <source>the check of the warm-up</source>
        <translation>die Prüfung des Warmlaufs</translation>
    </message>
    <message>
        <source>1 picture</source>
        <translation>1 Bild</translation>
    </message>
    <message>
        <source>{} pictures</source>
        <translation>{} Bilder</translation>
    </message>
    <message>
        <source>The machines have different names: &quot;{}&quot; before, &quot;{}&quot; after.</source>
        <translation>Die Maschinen haben verschiedene Namen: „{}“ vorher, „{}“ nachher.</translation>
    </message>
    <message>
        <source>The model is fitted, but does not describe this state, or a point is disturbed: its residuals are larger than the stated uncertainties allow.</source>
        <translation>Das Modell ist angepasst, beschreibt diesen Zustand aber nicht, oder ein Punkt ist gestört: seine Residuen sind größer, als die angegebenen Unsicherheiten erlauben.</translation>
    </message>
    <message>
        <source>The machine was at rest at constant temperatures: the drift is that of the instrument.</source>
        <translation>Die Maschine stand, und ihre Temperaturen hielten sich inzwischen: es driftet das Messgerät.</translation>
    </message>
    <message>
        <source>in {} of {} rows the combination of inputs is outside that of the training (by a factor of up to {:.1f}); the interval is wider there.</source>
        <translation>in {} von {} Zeilen stehen die Eingänge zusammen wie nie im Training (bis zu {:.1f}-mal außerhalb seines Bereichs); dort ist das Intervall breiter.</translation>
    </message>
    <message>
        <source>it deviates by {:.1f} µm from all other touches ({:.0f} times the touch noise); excluded</source>
        <translation>sie verfehlt um {:.1f} µm, was alle anderen Antastungen sagen ({:.0f}-mal das Antastrauschen); ausgelassen</translation>
    </message>
    <message>
        <source>its height deviates by {:.0f} µm from the {} other surface touches of {}; excluded</source>
        <translation>ihre Höhe liegt {:.0f} µm neben dem, was die {} anderen Flächenantastungen von {} sagen; ausgelassen</translation>
    </message>
    <message>
        <source>its height deviates by {:.0f} µm from the {} other surface touches</source>
        <translation>ihre Höhe liegt {:.0f} µm neben dem, was die {} anderen Flächenantastungen sagen</translation>
    </message>
    <message>
        <source>the log does not show whether it was at rest</source>
        <translation>nichts im Protokoll sagt, ob sie stand</translation>
    </message>
    <message>
        <source>{} measured {:+.1f} µm off the prediction, far beyond its uncertainty: used if the next cycle confirms it</source>
        <translation>{} {:+.1f} µm neben der Vorhersage gemessen, weit außerhalb ihrer Unsicherheit: wird verwendet, wenn der nächste Zyklus dasselbe sagt</translation>
    </message>
    <message>
        <source>{} measured {:+.2f} off the prediction, far beyond its uncertainty: used if the next measurement confirms it</source>
        <translation>{} {:+.2f} neben der Vorhersage gemessen, weit außerhalb ihrer Unsicherheit: wird verwendet, wenn die nächste Messung dasselbe sagt</translation>
    </message>
    <message>
        <source>{} and {} are collinear in the training and separate here: their effects cannot be distinguished from the training; vary one without the other there.</source>
        <translation>{} und {} haben sich im Training gemeinsam bewegt und trennen sich hier: Welche davon was verursacht, sagt das Training nicht; dort einmal eine ohne die andere laufen lassen.</translation>
    </message>
    <message>
        <source>, {:g} {} given: {}</source>
        <translation>, {:g} {} angegeben: {}</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is given a size in {}; allowed: {}.</source>
        <translation>„{}“ hat eine Größe in {}; zulässig: {}.</translation>
    </message>
    <message>
        <source>answer &quot;{}&quot; {}; allowed: EFFECT[:DRIVER[:SIZE]], for example column.bending.a:column_difference:12um.</source>
        <translation>Antwort „{}“ {}; zulässig: EFFECT[:DRIVER[:SIZE]], zum Beispiel column.bending.a:column_difference:12um.</translation>
    </message>
    <message>
        <source>has a size without the unit µm or µrad</source>
        <translation>hat eine Größe ohne die Einheit µm oder µrad</translation>
    </message>
    <message>
        <source>One value since {}: control limits begin with the fifth.</source>
        <translation>Ein Wert seit {}: Eingriffsgrenzen beginnen mit dem fünften.</translation>
    </message>
    <message>
        <source>${} has {} numbers in brackets.</source>
        <translation>${} hat {} Zahlen in Klammern.</translation>
    </message>
    <message>
        <source>E{}{} changes by {:.4g} mm from {:g} to {:g} mm; allowed from one point to the next: 1/64 of their distance.</source>
        <translation>E{}{} ändert sich um {:.4g} mm von {:g} bis {:g} mm; erlaubt von einem Punkt zum nächsten: 1/64 ihres Abstands.</translation>
    </message>
    <message>
        <source>E{}{} is {:.4g} mm at {:g} mm; allowed in a sag compensation: -1 to 1 mm.</source>
        <translation>E{}{} ist {:.4g} mm bei {:g} mm; erlaubt in einer Durchhangkompensation: -1 bis 1 mm.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a number from 0 on.</source>
        <translation>„{}“ ist keine Zahl ab 0.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not a number.</source>
        <translation>„{}“ ist keine Zahl.</translation>
    </message>
    <message>
        <source>&quot;{}&quot; is not an axis; allowed: X, Y or Z.</source>
        <translation>„{}“ ist keine Achse; erlaubt: X, Y oder Z.</translation>
    </message>
    <message>
        <source>a detection unit of {:g} µm is not allowed; allowed: above 0.</source>
        <translation>eine Erfassungseinheit von {:g} µm ist nicht erlaubt; erlaubt: über 0.</translation>
    </message>
    <message>
        <source>does not say over which axis its values are.</source>
        <translation>sagt nicht, über welcher Achse seine Werte stehen.</translation>
    </message>
    <message>
        <source>lacks its axis, its values or what its head says of them.</source>
        <translation>fehlt die Achse, fehlen Werte oder was sein Kopf von ihnen sagt.</translation>
    </message>
    <message>
        <source>over the position of</source>
        <translation>über der Position von</translation>
    </message>
    <message>
        <source>points {} to {} of {} are not allowed; allowed: 0 to 1023.</source>
        <translation>die Punkte {} bis {} von {} sind nicht erlaubt; erlaubt: 0 bis 1023.</translation>
    </message>
    <message>
        <source>table {} lacks its axes, its values or their distance.</source>
        <translation>Tabelle {} fehlen Achsen, Werte oder deren Abstand.</translation>
    </message>
    <message>
        <source>the compensation of {} changes by {} detection units from {:g} to {:g} mm; allowed in pitch error data: -128 to 127.</source>
        <translation>die Kompensation von {} ändert sich um {} Erfassungseinheiten von {:g} bis {:g} mm; erlaubt in Steigungsfehlerdaten: -128 bis 127.</translation>
    </message>
    <message>
        <source>{} is not allowed; allowed: -128 to 127.</source>
        <translation>{} ist nicht erlaubt; erlaubt: -128 bis 127.</translation>
    </message>
    <message>
        <source>Fanuc pitch error data of {}</source>
        <translation>Fanuc-Steigungsfehlerdaten von {}</translation>
    </message>
    <message>
        <source>Heidenhain compensation values over {}</source>
        <translation>Heidenhain-Kompensationswerte über {}</translation>
    </message>
    <message>
        <source>No pitch error data are written for Fanuc until it is stated which way a positive value moves the axis: public documents give their format, not that. Set one value of 10 detection units on the control, move over its section in the positive direction with an indicator on the axis, and see whether it goes further than before (positive) or less far (negative).</source>
        <translation>Für Fanuc werden keine Steigungsfehlerdaten geschrieben, solange nicht angegeben ist, wohin ein positiver Wert die Achse bewegt: Öffentliche Unterlagen geben ihr Format an, das nicht. An der Steuerung einen Wert auf 10 Erfassungseinheiten setzen, mit einer Messuhr an der Achse in positiver Richtung über seinen Abschnitt fahren und sehen, ob sie weiter geht als zuvor (positiv) oder weniger weit (negativ).</translation>
    </message>
    <message>
        <source>Siemens sag and angularity error compensation</source>
        <translation>Siemens-Durchhang- und Winkligkeitsfehlerkompensation</translation>
    </message>
    <message>
        <source>a detection unit of {:g} µm is not allowed; allowed: 0.001 to 100.</source>
        <translation>eine Erfassungseinheit von {:g} µm ist nicht erlaubt; erlaubt: 0,001 bis 100.</translation>
    </message>
    <message>
        <source>Program (G10 L50) with steps in detection units of {:g} µm from point to point, {}: a positive value moves the axis to {}, as stated. Points, distance and magnification are those of its head (parameters 3620 to 3624). It stands in place of the data that the control has. Beyond what was measured it is extrapolated; the ISO 230-1 tables say where.</source>
        <translation>Programm (G10 L50) mit Schritten in Erfassungseinheiten von {:g} µm von Punkt zu Punkt, {}: Ein positiver Wert bewegt die Achse nach {}, wie angegeben. Punkte, Abstand und Faktor sind die seines Kopfes (Parameter 3620 bis 3624). Es steht anstelle der Daten, die die Steuerung hat. Jenseits des Gemessenen ist es extrapoliert; die Tabellen nach ISO 230-1 sagen, wo.</translation>
    </message>
    <message>
        <source>Values of a .COM table in mm, to be entered in the control&apos;s table editor (the layout of the file is not public): the deviation itself, {}, zero at the first position; positive where the axis travels too far. In the .CMA it is the table of {}. Beyond what was measured it is extrapolated; the ISO 230-1 tables say where.</source>
        <translation>Werte einer .COM-Tabelle in mm, im Tabelleneditor der Steuerung einzugeben (der Aufbau der Datei ist nicht öffentlich): die Abweichung selbst, {}, null an der ersten Position; positiv, wo die Achse zu weit verfährt. In der .CMA ist es die Tabelle von {}. Jenseits des Gemessenen ist es extrapoliert; die Tabellen nach ISO 230-1 sagen, wo.</translation>
    </message>
    <message>
        <source>The file {} is not written: {}</source>
        <translation>Die Datei {} wird nicht geschrieben: {}</translation>
    </message>
    <message>
        <source>0, or a size of at least {:g}: µm/(m·K), where steel has 11.5, not 1/K</source>
        <translation>0, oder ein Betrag von mindestens {:g}: µm/(m·K), worin Stahl 11,5 hat, nicht 1/K</translation>
    </message>
    <message>
        <source>Held out: dashed points took no part in any fit.</source>
        <translation>Validierungsdaten: gestrichelte Punkte nahmen an keiner Anpassung teil.</translation>
    </message>
    <message>
        <source>What the model does not describe (X {:.1f} µm, Y {:.1f} µm, Z {:.1f} µm) is part of the uncertainty of every correction.</source>
        <translation>Was das Modell nicht beschreibt (X {:.1f} µm, Y {:.1f} µm, Z {:.1f} µm), ist Teil der Unsicherheit jeder Korrektur.</translation>
    </message>
    <message>
        <source>Not decidable yet: {}.</source>
        <translation>Noch nicht entscheidbar: {}.</translation>
    </message>
    <message>
        <source>Not known yet: drift of more than {} µm/h is possible: {}; measure longer.</source>
        <translation>Noch nicht bekannt: Drift von mehr als {} µm/h ist möglich: {}; länger messen.</translation>
    </message>
    <message>
        <source>Not settled: drift of more than {} µm/h: {}.</source>
        <translation>Nicht eingelaufen: Drift von mehr als {} µm/h: {}.</translation>
    </message>
    <message>
        <source>beyond the record</source>
        <translation>länger als die Aufzeichnung</translation>
    </message>
    <message>
        <source>not decidable</source>
        <translation>nicht entscheidbar</translation>
    </message>
    <message>
        <source>not seen</source>
        <translation>nicht zu sehen</translation>
    </message>
    <message>
        <source>too short</source>
        <translation>zu kurz</translation>
    </message>
    <message>
        <source>, time constant beyond the record</source>
        <translation>, Zeitkonstante länger als die Aufzeichnung</translation>
    </message>
    <message>
        <source>, time constant too short to be determined</source>
        <translation>, Zeitkonstante zu kurz, um bestimmt zu werden</translation>
    </message>
    <message>
        <source>{} cannot be determined under the scan model {} ({}): {:.1f} mrad is what the mounting is assumed to have, with a standard uncertainty of {:.1f} mrad that dx, dy carry along. </source>
        <translation>{} ist unter dem Scanmodell {} nicht bestimmbar ({}): angenommen sind {:.1f} mrad aus dem Anbau, mit einer Standardunsicherheit von {:.1f} mrad, die dx und dy mittragen. </translation>
    </message>
    <message>
        <source>{} above {:.0f} mm</source>
        <translation>{} über {:.0f} mm</translation>
    </message>
    <message>
        <source>{} below {:.0f} mm</source>
        <translation>{} unter {:.0f} mm</translation>
    </message>
    <message>
        <source>1 input</source>
        <translation>1 Eingang</translation>
    </message>
    <message>
        <source>{} inputs</source>
        <translation>{} Eingänge</translation>
    </message>
    <message>
        <source>ARX model</source>
        <translation>ARX-Modell</translation>
    </message>
    <message>
        <source>model of first-order time constants</source>
        <translation>Modell aus Zeitkonstanten erster Ordnung</translation>
    </message>
    <message>
        <source>output-error model</source>
        <translation>Ausgangsfehlermodell</translation>
    </message>
    <message>
        <source>step-response model</source>
        <translation>Sprungantwortmodell</translation>
    </message>
    <message>
        <source>{} of all points moves in one pattern from state to state, {:.2f} {} rms</source>
        <translation>{} aller Punkte bewegt sich von Zustand zu Zustand in einem gemeinsamen Muster, {:.2f} {} rms</translation>
    </message>
    <message>
        <source>it was at work ({}) and temperatures changed ({})</source>
        <translation>sie in Betrieb war ({}) und sich Temperaturen änderten ({})</translation>
    </message>
    <message>
        <source>temperatures changed ({})</source>
        <translation>sich Temperaturen änderten ({})</translation>
    </message>
    <message>
        <source>covariance {} of rows {} and {} is not allowed: entry {} gives {}; allowed: one value for a pair.</source>
        <translation>Kovarianz {} der Zeilen {} und {} ist nicht zulässig: Eintrag {} nennt {}; zulässig: ein Wert für ein Paar.</translation>
    </message>
    <message>
        <source>covariance {} of rows {} and {} is not allowed; allowed: -{:.6g} to {:.6g}, the product of their standard uncertainties.</source>
        <translation>Kovarianz {} der Zeilen {} und {} ist nicht zulässig; zulässig: -{:.6g} bis {:.6g}, das Produkt ihrer Standardunsicherheiten.</translation>
    </message>
    <message>
        <source>$AN_CEC in mm, one table for each axis that is moved over the position of another: the deviation itself, {}, zero at the reference position; a positive value moves the axis in the negative direction. With the tables of $AA_ENC_COMP all displacements along the axes through the reference position are compensated; what depends on two axes together (the higher-order terms) is in no such table. It stands in place of the tables that the control has. Beyond what was measured it is extrapolated; the ISO 230-1 tables say where.</source>
        <translation>$AN_CEC in mm, eine Tabelle für jede Achse, die über der Position einer anderen bewegt wird: die Abweichung selbst, {}, null an der Bezugsposition; ein positiver Wert bewegt die Achse in negativer Richtung. Mit den Tabellen von $AA_ENC_COMP sind alle Verschiebungen entlang der Achsen durch die Bezugsposition kompensiert; was von zwei Achsen zugleich abhängt (die Terme höherer Ordnung), steht in keiner solchen Tabelle. Sie steht anstelle der Tabellen, die die Steuerung hat. Jenseits des Gemessenen ist sie extrapoliert; die Tabellen nach ISO 230-1 sagen, wo.</translation>
    </message>
    <message>
        <source>the image is cut short: it has {} bytes, {:.0f} x {:.0f} pixels need {:.0f}; copy it again.</source>
        <translation>Das Bild ist abgeschnitten: es hat {} Bytes, {:.0f} x {:.0f} Pixel brauchen {:.0f}; bitte neu kopieren.</translation>
    </message>
    <message>
        <source>1, or -1 if the table is counted the other way round</source>
        <translation>1, oder -1, wenn der Tisch andersherum gezählt wird</translation>
    </message>
    <message>
        <source>a standard uncertainty of {:g}; allowed: 0 or more.</source>
        <translation>Standardunsicherheit {:g}; erlaubt: 0 oder mehr.</translation>
    </message>
    <message>
        <source>a table angle of {:g}° is not allowed; allowed: {:g} to {:g}°.</source>
        <translation>Der Tischwinkel {:g}° ist nicht erlaubt; erlaubt: {:g} bis {:g}°.</translation>
    </message>
    <message>
        <source>cannot be touched {:g} mm deep: the tip of stylus {} lies {:g} mm below the spindle reference, which stays {:g} mm above the bar; allowed: depth_mm up to {:g} mm.</source>
        <translation>kann nicht {:g} mm tief angetastet werden: die Kugel des Tasters {} liegt {:g} mm unter der Spindelreferenz, die {:g} mm über der Leiste bleibt; erlaubt: depth_mm bis {:g} mm.</translation>
    </message>
    <message>
        <source>the spindle reference goes to {:.2f} mm above the top of the bar; allowed: {:.2f} mm</source>
        <translation>die Spindelreferenz fährt auf {:.2f} mm über der Oberseite der Leiste; erlaubt: {:.2f} mm</translation>
    </message>
    <message>
        <source>compensation = minus the predicted deviation, to be added to the command; deviation = actual minus commanded, as the log measures it; rms_after is of measured deviation plus compensation, both about their mean over the rows that trained the model (over all rows where none did); reduction_percent is positive where the rms became smaller</source>
        <translation>Kompensation = minus die vorhergesagte Abweichung, zum Sollwert zu addieren; Abweichung = Ist minus Soll, wie das Protokoll sie misst; rms_after ist von gemessener Abweichung plus Kompensation, beide um ihren Mittelwert über die Zeilen, die das Modell trainiert haben (über alle Zeilen, wo es keine gibt); reduction_percent ist positiv, wo der rms kleiner wurde</translation>
    </message>
    <message>
        <source>none of its touches is left, so nothing is determined:</source>
        <translation>keine ihrer Antastungen ist übrig, also ist nichts bestimmt:</translation>
    </message>
    <message>
        <source>{} far outside the scan left out.</source>
        <translation>{} weit außerhalb des Scans weggelassen.</translation>
    </message>
    <message>
        <source>1 point</source>
        <translation>1 Punkt</translation>
    </message>
    <message>
        <source>scan {} as {}, starting at {:g} mm</source>
        <translation>{} als {} scannen, beginnend bei {:g} mm</translation>
    </message>
    <message>
        <source>a level cannot be read over {:g} s of a record of {:g} s; allowed: 0 s to {:g} s.</source>
        <translation>ein Niveau kann nicht über {:g} s einer Aufzeichnung von {:g} s gelesen werden; zulässig: 0 s bis {:g} s.</translation>
    </message>
    <message>
        <source>the columns are separated by semicolons; allowed: commas, and numbers with a decimal point.</source>
        <translation>die Spalten sind durch Semikolons getrennt; zulässig: Kommas und Zahlen mit Dezimalpunkt.</translation>
    </message>
    <message>
        <source>the columns are separated by tabs; allowed: commas.</source>
        <translation>die Spalten sind durch Tabulatoren getrennt; zulässig: Kommas.</translation>
    </message>
</context>
<context>
    <name>help</name>
    <message>
        <source>30 GB</source>
        <translation>30 GB</translation>
    </message>
    <message>
        <source>329 million</source>
        <translation>329 Millionen</translation>
    </message>
    <message>
        <source>34 GB</source>
        <translation>34 GB</translation>
    </message>
    <message>
        <source>36.5 million</source>
        <translation>36,5 Millionen</translation>
    </message>
    <message>
        <source>440 million</source>
        <translation>440 Millionen</translation>
    </message>
    <message>
        <source>8 GB</source>
        <translation>8 GB</translation>
    </message>
    <message>
        <source>80 GB</source>
        <translation>80 GB</translation>
    </message>
    <message>
        <source>9 GB</source>
        <translation>9 GB</translation>
    </message>
    <message>
        <source>&lt;b&gt;Effects:&lt;/b&gt; the button beside &lt;i&gt;Search&lt;/i&gt; lists every effect this machine can have, with its physics, formula and shape. What is switched off is not named. &lt;i&gt;New effect&lt;/i&gt; writes one of your own: drivers are columns of the log, shapes are expressions in x, y, z; both are checked while you type. The campaign folder is never written to.</source>
        <translation>&lt;b&gt;Effekte:&lt;/b&gt; Die Schaltfläche neben &lt;i&gt;Suchen&lt;/i&gt; listet jeden Effekt, den diese Maschine haben kann, mit Physik, Formel und Form. Was abgeschaltet ist, wird nicht benannt. &lt;i&gt;Neuer Effekt&lt;/i&gt; legt einen eigenen an: Treiber sind Spalten des Protokolls, Formen sind Ausdrücke in x, y, z; beides wird während der Eingabe geprüft. In den Kampagnenordner wird nie geschrieben.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Gap:&lt;/b&gt; rms, peak-to-peak and fit before and after, also on data that were held out of the fit. What was measured is known up to a constant of each point and component; the line of a model is drawn with the one that fits best.</source>
        <translation>&lt;b&gt;Differenz:&lt;/b&gt; rms, Spitze-Spitze und Anpassungsgüte vorher und nachher, auch an Validierungsdaten. Messwerte sind bis auf eine Konstante je Punkt und Komponente bekannt; die Linie eines Modells ist mit der am besten passenden gezeichnet.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Into the simulation:&lt;/b&gt; a simulation that can be run (&lt;i&gt;simulator.json&lt;/i&gt;) is searched as well: its mechanisms that are switched off, its uncertain parameters and the sensors that drive it. &lt;i&gt;Put it into the simulation&lt;/i&gt; fits the physical parameters on the simulation itself, runs it again and judges its own new prediction on data that were held out. The new version is written to a folder of its own; no program runs before you say so.</source>
        <translation>&lt;b&gt;In die Simulation:&lt;/b&gt; Eine ausführbare Simulation (&lt;i&gt;simulator.json&lt;/i&gt;) wird ebenfalls durchsucht: ihre abgeschalteten Mechanismen, ihre unsicheren Parameter und die Sensoren, die sie antreiben. &lt;i&gt;In die Simulation einsetzen&lt;/i&gt; passt die physikalischen Parameter an der Simulation selbst an, führt sie erneut aus und beurteilt ihre neue Vorhersage an Validierungsdaten. Die neue Version wird in einen eigenen Ordner geschrieben; kein Programm läuft ohne Ihre Zustimmung.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Laser profiler:&lt;/b&gt; the whole artefact in every scan, cold and warm with the same settings.</source>
        <translation>&lt;b&gt;Laser-Profilsensor:&lt;/b&gt; der ganze Prüfkörper in jedem Scan, kalt und warm mit denselben Einstellungen.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Laser profiler:&lt;/b&gt; warm and cold clouds are laid on each other; a component that the scan cannot see has no value and says why.</source>
        <translation>&lt;b&gt;Laser-Profilsensor:&lt;/b&gt; Warme und kalte Punktwolken werden zur Deckung gebracht; eine Komponente, die der Scan nicht erfassen kann, hat keinen Wert und nennt den Grund.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Microscope:&lt;/b&gt; 3 or more spindle orientations at one position, 3 to 5 positions along X and Y, 5 or more heights for the focus.</source>
        <translation>&lt;b&gt;Mikroskop:&lt;/b&gt; mindestens 3 Spindelstellungen an einer Position, 3 bis 5 Positionen entlang X und Y, mindestens 5 Höhen für den Fokus.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Microscope:&lt;/b&gt; the centre of rotation is free of how the camera sits in the spindle.</source>
        <translation>&lt;b&gt;Mikroskop:&lt;/b&gt; Der Drehmittelpunkt hängt nicht davon ab, wie die Kamera in der Spindel sitzt.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Next:&lt;/b&gt; what to measure to distinguish rivals, and how the search decided.</source>
        <translation>&lt;b&gt;Nächste Messung:&lt;/b&gt; was zu messen ist, um konkurrierende Erklärungen zu unterscheiden, und wie die Suche entschieden hat.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Noise:&lt;/b&gt; what was taken as noise: its scale (actual scatter over stated σ), the shift common to all points of a state, tails, the clock of the log, and outlying readings. Each reading can be looked at, excluded and brought back.</source>
        <translation>&lt;b&gt;Rauschen:&lt;/b&gt; was als Rauschen galt: sein Maßstab (tatsächliche Streuung zu angegebenem σ), die allen Punkten eines Zustands gemeinsame Verschiebung, die Ausläufer der Verteilung, die Uhr des Protokolls und Ausreißer. Jeder Messwert lässt sich ansehen, ausschließen und zurückholen.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Remains:&lt;/b&gt; what is smooth in time and space and neither effect nor noise: its rms in every component, its time history beside what the effects explain, its pattern over the points.</source>
        <translation>&lt;b&gt;Was verbleibt:&lt;/b&gt; was über Zeit und Ort glatt verläuft und weder Effekt noch Rauschen ist: sein rms in jeder Komponente, sein zeitlicher Verlauf neben dem, was die Effekte erklären, sein Muster über den Punkten.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Touch probe:&lt;/b&gt; a probe reads true position minus deviation: the observation is minus the change of what it reads.</source>
        <translation>&lt;b&gt;Messtaster:&lt;/b&gt; Er zeigt wahre Position minus Abweichung an: Die Beobachtung ist die negative Änderung der Anzeige.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Touch probe:&lt;/b&gt; each feature from all sides; the stylus tight, the probe dry.</source>
        <translation>&lt;b&gt;Messtaster:&lt;/b&gt; jedes Element von allen Seiten; Tastereinsatz fest, Messtaster trocken.</translation>
    </message>
    <message>
        <source>&lt;b&gt;What:&lt;/b&gt; the effect, its parameters, and which rivals these data do not distinguish from it; the ten most probable effects with their probabilities, named or not.</source>
        <translation>&lt;b&gt;Was:&lt;/b&gt; der Effekt, seine Parameter und die konkurrierenden Erklärungen, die diese Daten nicht von ihm unterscheiden; die zehn wahrscheinlichsten Effekte mit ihren Wahrscheinlichkeiten, benannt oder nicht.</translation>
    </message>
    <message>
        <source>&lt;b&gt;Where:&lt;/b&gt; the points and times at which the residual is larger than noise explains.</source>
        <translation>&lt;b&gt;Wo:&lt;/b&gt; die Punkte und Zeiten, an denen das Residuum größer ist, als das Rauschen erklärt.</translation>
    </message>
    <message>
        <source>&lt;b&gt;rms of the fit&lt;/b&gt; much above the uncertainty: something is missing in the model. &lt;b&gt;rms of the validation&lt;/b&gt; much above that of the fit: too few points.</source>
        <translation>&lt;b&gt;rms der Anpassung&lt;/b&gt; weit über der Unsicherheit: im Modell fehlt etwas. &lt;b&gt;rms der Validierung&lt;/b&gt; weit über dem der Anpassung: zu wenige Punkte.</translation>
    </message>
    <message>
        <source>&lt;b&gt;rows&lt;/b&gt;</source>
        <translation>&lt;b&gt;Zeilen&lt;/b&gt;</translation>
    </message>
    <message>
        <source>&lt;b&gt;size&lt;/b&gt;</source>
        <translation>&lt;b&gt;Größe&lt;/b&gt;</translation>
    </message>
    <message>
        <source>&lt;b&gt;table&lt;/b&gt;</source>
        <translation>&lt;b&gt;Tabelle&lt;/b&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;Live …&lt;/i&gt; closes the loop at the control: open a plan, press Start, read what will move, and confirm it at the machine. The page says whether the compensation is active, what it adds per axis and how sure that is (one standard uncertainty of the model; no number before a measuring cycle has judged it).</source>
        <translation>&lt;i&gt;Live …&lt;/i&gt; schließt den Regelkreis an der Steuerung: einen Plan öffnen, „Starten“ drücken, lesen, was sich bewegen wird, und es an der Maschine bestätigen. Die Seite zeigt, ob die Kompensation aktiv ist, was sie je Achse aufschaltet und wie sicher das ist (eine Standardunsicherheit des Modells; keine Zahl, bevor ein Messzyklus sie geprüft hat).</translation>
    </message>
    <message>
        <source>&lt;i&gt;Publish this session&lt;/i&gt; puts its campaigns with their newest results into the store. Publishing again adds nothing. Where the store cannot be reached, what is published waits in the session.</source>
        <translation>&lt;i&gt;Diese Sitzung veröffentlichen&lt;/i&gt; legt ihre Kampagnen mit den neuesten Ergebnissen im Speicher ab. Erneutes Veröffentlichen fügt nichts hinzu. Ist der Speicher nicht erreichbar, wartet das Veröffentlichte in der Sitzung.</translation>
    </message>
    <message>
        <source>&lt;i&gt;Stop&lt;/i&gt; lets the compensation fade to zero. If Spindrift stops responding, the control lets it fade as well, or holds it: your choice. A loop that was ended goes on from its folder.</source>
        <translation>&lt;i&gt;Anhalten&lt;/i&gt; lässt die Kompensation auf null abklingen. Wenn Spindrift nicht mehr antwortet, lässt die Steuerung sie ebenfalls abklingen oder hält sie: nach Ihrer Wahl. Ein beendeter Regelkreis wird aus seinem Ordner fortgesetzt.</translation>
    </message>
    <message>
        <source>&lt;i&gt;U = 2 u&#xa0; (expanded uncertainty, about 95 %)&lt;/i&gt;</source>
        <translation>&lt;i&gt;U = 2 u&#xa0; (erweiterte Messunsicherheit, etwa 95 %)&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;c = mean centre of the circle that a pattern draws while the spindle turns;&#xa0; ΔXY = c(state) − c(first),&#xa0; ΔZ from the peak of sharpness over height&lt;/i&gt;</source>
        <translation>&lt;i&gt;c = mittlerer Mittelpunkt des Kreises, den ein Muster beim Drehen der Spindel beschreibt;&#xa0; ΔXY = c(Zustand) − c(erster),&#xa0; ΔZ aus dem Maximum der Schärfe über der Höhe&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;correction = − predicted deviation;&#xa0; expected residual error = sqrt(model uncertainty² + rms residual²)&lt;/i&gt;</source>
        <translation>&lt;i&gt;Korrektur = − vorhergesagte Abweichung;&#xa0; erwartetes Residuum nach der Kompensation = sqrt(Modellunsicherheit² + rms-Residuum²)&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;d(t) = a + b (1 − exp(−t / τ)),&#xa0; settled when |b| / τ · exp(−t / τ) &amp;lt; 1 µm/h&lt;/i&gt;</source>
        <translation>&lt;i&gt;d(t) = a + b (1 − exp(−t / τ)),&#xa0; eingelaufen, wenn |b| / τ · exp(−t / τ) &amp;lt; 1 µm/h&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;deviation = actual − commanded position of the tool relative to the table&lt;/i&gt;</source>
        <translation>&lt;i&gt;Abweichung = Ist- − Sollposition des Werkzeugs relativ zum Tisch&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;difference = pane − pane 1;&#xa0; u(difference)² = u(pane)² + u(pane 1)²&lt;/i&gt;</source>
        <translation>&lt;i&gt;Differenz = Bereich − Bereich 1;&#xa0; u(Differenz)² = u(Bereich)² + u(Bereich 1)²&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;ex = EX − (EC + EC0Y) y + EB z + α&lt;sub&gt;X&lt;/sub&gt; x,&#xa0; ey = EY + EC x − EA z + α&lt;sub&gt;Y&lt;/sub&gt; y,&#xa0; ez = EZ − EB x + EA y&lt;/i&gt;</source>
        <translation>&lt;i&gt;ex = EX − (EC + EC0Y) y + EB z + α&lt;sub&gt;X&lt;/sub&gt; x,&#xa0; ey = EY + EC x − EA z + α&lt;sub&gt;Y&lt;/sub&gt; y,&#xa0; ez = EZ − EB x + EA y&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;met: |residual| + U ≤ goal;&#xa0; not met: |residual| − U &amp;gt; goal;&#xa0; U = 2 u&lt;/i&gt;</source>
        <translation>&lt;i&gt;erreicht: |Residuum| + U ≤ Ziel;&#xa0; nicht erreicht: |Residuum| − U &amp;gt; Ziel;&#xa0; U = 2 u&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;residual = observation − prediction;&#xa0; ΔBIC = Δχ² − k ln n,&#xa0; above 10: strong evidence&lt;/i&gt;</source>
        <translation>&lt;i&gt;Residuum = Beobachtung − Vorhersage;&#xa0; ΔBIC = Δχ² − k ln n,&#xa0; über 10: starke Evidenz&lt;/i&gt;</translation>
    </message>
    <message>
        <source>&lt;i&gt;usable when: code found, sharp, not over-exposed; touch within 5 standard deviations of its feature; scan complete&lt;/i&gt;</source>
        <translation>&lt;i&gt;verwendbar, wenn: Code gefunden, scharf, nicht überbelichtet; Antastung innerhalb von 5 Standardabweichungen ihres Elements; Scan vollständig&lt;/i&gt;</translation>
    </message>
    <message>
        <source>A chain is written from the workpiece to the tool; an axis that carries the workpiece has a prime: V [w-X&apos;-Y&apos;-b-Z-t].</source>
        <translation>Eine Kette wird vom Werkstück zum Werkzeug geschrieben; eine Achse, die das Werkstück trägt, hat einen Strich: V [w-X&apos;-Y&apos;-b-Z-t].</translation>
    </message>
    <message>
        <source>A day is 10,000 campaigns. At the rates that were measured (1,000 in 0.5 s to 1.7 s, on two processors that others used as well) they are published in 5 s to 17 s.</source>
        <translation>Ein Tag sind 10.000 Kampagnen. Bei den gemessenen Raten (1.000 in 0,5 s bis 1,7 s auf zwei auch anderweitig genutzten Prozessoren) sind sie in 5 s bis 17 s veröffentlicht.</translation>
    </message>
    <message>
        <source>A log alone has a report too: conditions, displacements, ISO 230-3 where it is such a test, model and compensation.</source>
        <translation>Auch ein Protokoll allein hat einen Bericht: Bedingungen, Verlagerungen, ISO 230-3, wo es eine solche Prüfung ist, Modell und Kompensation.</translation>
    </message>
    <message>
        <source>A model no longer holds after a spindle change, a re-levelling, a crash, a repair or a move, after a named step or drift, and where a later campaign came out otherwise.</source>
        <translation>Ein Modell gilt nicht mehr nach Spindelwechsel, Neuausrichtung, Kollision, Reparatur oder Umzug, nach einem benannten Sprung oder einer benannten Drift und wo eine spätere Kampagne anders ausfiel.</translation>
    </message>
    <message>
        <source>A trend has one value a campaign. Dashed: control limits (3 standard deviations: scatter from campaign to campaign and uncertainty of the value). The moving average (EWMA) sees small shifts that last. Limits begin anew after an event that makes the machine another one. A change is named where chance makes one in fewer than 1 of 100 records. &lt;i&gt;Report&lt;/i&gt; writes all of a machine into one file.</source>
        <translation>Ein Verlauf hat einen Wert je Kampagne. Gestrichelt: Eingriffsgrenzen (3 Standardabweichungen: Streuung von Kampagne zu Kampagne und Unsicherheit des Werts). Der gleitende Mittelwert (EWMA) erkennt kleine, anhaltende Verschiebungen. Nach einem Ereignis, das die Maschine verändert, beginnen die Grenzen neu. Eine Änderung wird benannt, wo der Zufall sie in weniger als 1 von 100 Verläufen hervorbringt. &lt;i&gt;Bericht&lt;/i&gt; schreibt alles zu einer Maschine in eine Datei.</translation>
    </message>
    <message>
        <source>An uncertainty is one standard deviation unless stated otherwise.</source>
        <translation>Eine Unsicherheit ist, wenn nicht anders angegeben, eine Standardabweichung.</translation>
    </message>
    <message>
        <source>Arrows are drawn larger by the factor that is stated. A click on a point chooses its row, a row its point.</source>
        <translation>Pfeile sind um den angegebenen Faktor vergrößert. Ein Klick auf einen Punkt wählt seine Zeile, eine Zeile ihren Punkt.</translation>
    </message>
    <message>
        <source>Batches</source>
        <translation>Batch-Aufträge</translation>
    </message>
    <message>
        <source>Below the trend, enter what was done to the machine: a new spindle, a re-levelling, a crash, a repair, a move, or a note; with its day (UTC) and a few words. All but a note let the limits begin anew.</source>
        <translation>Unter dem Verlauf wird eingetragen, was an der Maschine geschah: neue Spindel, Neuausrichtung, Kollision, Reparatur, Umzug oder eine Notiz; mit Tag (UTC) und einigen Worten. Alle außer einer Notiz lassen die Grenzen neu beginnen.</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Kalibrieren</translation>
    </message>
    <message>
        <source>Capture</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Captures become observations: a deviation with its uncertainty, a time and a thermal state.</source>
        <translation>Aus Aufnahmen werden Beobachtungen: eine Abweichung mit ihrer Unsicherheit, einer Zeit und einem thermischen Zustand.</translation>
    </message>
    <message>
        <source>Choose a plan (a JSON file, format spindrift-batch) and press &lt;i&gt;Start&lt;/i&gt;: all processors of this computer work on its campaigns or seeds, beside whatever else you do. The table shows how far each batch of the store is and what it has cost. &lt;i&gt;Cancel the batch&lt;/i&gt; stops it wherever it runs, and &lt;i&gt;Resume&lt;/i&gt; goes on, here, after a cancellation, a crash or a failure; each item has its answer exactly once. A batch that you only stop in the job bar, or by closing the window, is not cancelled: other computers go on.</source>
        <translation>Einen Plan wählen (JSON-Datei, Format spindrift-batch) und &lt;i&gt;Starten&lt;/i&gt; drücken: Alle Prozessoren dieses Rechners bearbeiten seine Kampagnen oder Startwerte, neben allem, was Sie sonst tun. Die Tabelle zeigt, wie weit jeder Batch-Auftrag des Speichers ist und was er gekostet hat. &lt;i&gt;Batch-Auftrag abbrechen&lt;/i&gt; hält ihn überall an, und &lt;i&gt;Auf diesem Rechner fortsetzen&lt;/i&gt; führt ihn nach Abbruch, Absturz oder Fehler hier weiter; jedes Element wird genau einmal bearbeitet. Ein Batch-Auftrag, der nur in der Auftragsleiste oder durch Schließen des Fensters angehalten wird, ist nicht abgebrochen: Andere Rechner arbeiten weiter.</translation>
    </message>
    <message>
        <source>Cold repeatability: the same point again and again comes back within half a resolution.</source>
        <translation>Wiederholpräzision kalt: Derselbe Punkt kommt bei wiederholter Messung innerhalb einer halben Auflösung wieder.</translation>
    </message>
    <message>
        <source>Compensate</source>
        <translation>Kompensieren</translation>
    </message>
    <message>
        <source>Describe the machine once: the chain from workpiece to tool, the travel of each axis, where its drive is held and where its scale counts from. Everything that is fitted and drawn later takes its frame from here.</source>
        <translation>Die Maschine einmal beschreiben: die Kette vom Werkstück zum Werkzeug, den Verfahrweg jeder Achse, wo ihr Antrieb gelagert ist und von wo ihr Maßstab zählt. Alles, was später angepasst und gezeichnet wird, bezieht sich auf dieses Koordinatensystem.</translation>
    </message>
    <message>
        <source>Discrepancy</source>
        <translation>Diskrepanz</translation>
    </message>
    <message>
        <source>EZ</source>
        <translation>EZ</translation>
    </message>
    <message>
        <source>Each capture is judged at once, while you stand at the machine. Take again what is marked; nothing that is there is altered.</source>
        <translation>Jede Aufnahme wird sofort beurteilt, solange man an der Maschine ist. Markiertes erneut aufnehmen; Vorhandenes wird nicht verändert.</translation>
    </message>
    <message>
        <source>Each file states its sign and its units; try one point by hand before you trust a table.</source>
        <translation>Jede Datei nennt ihr Vorzeichen und ihre Einheiten; einen Punkt von Hand prüfen, bevor man einer Tabelle vertraut.</translation>
    </message>
    <message>
        <source>Everything in one document: machine, conditions, captures, results with their uncertainty, the models, the discrepancy and where each number came from.</source>
        <translation>Alles in einem Dokument: Maschine, Bedingungen, Aufnahmen, Ergebnisse mit ihrer Unsicherheit, Modelle, Diskrepanz und die Herkunft jeder Zahl.</translation>
    </message>
    <message>
        <source>Excluding a capture needs a reason and can be taken back (Ctrl+Z).</source>
        <translation>Der Ausschluss einer Aufnahme braucht einen Grund und lässt sich rückgängig machen (Strg+Z).</translation>
    </message>
    <message>
        <source>Exclusions stand in it with their reasons, and the notes of this session (Edit, Notes).</source>
        <translation>Ausschlüsse stehen mit ihren Gründen darin, ebenso die Notizen dieser Sitzung (Bearbeiten, Notizen).</translation>
    </message>
    <message>
        <source>Frame: right-handed, axes X Y Z of ISO 841. Positions in mm, deviations in µm, tilts in µrad.</source>
        <translation>Koordinatensystem: rechtshändig, Achsen X Y Z nach ISO 841. Positionen in mm, Abweichungen in µm, Winkel in µrad.</translation>
    </message>
    <message>
        <source>HTML is self-contained; PDF has pages to sign and is what this step shows.</source>
        <translation>HTML ist in sich abgeschlossen; PDF hat Seiten zum Unterschreiben und wird in diesem Schritt gezeigt.</translation>
    </message>
    <message>
        <source>ISO 230-1 tables hold errors (EXX, EYX, …), not corrections: the sign is that of the deviation.</source>
        <translation>Tabellen nach ISO 230-1 enthalten Abweichungen (EXX, EYX, …), keine Korrekturen: Das Vorzeichen ist das der Abweichung.</translation>
    </message>
    <message>
        <source>If nothing of the catalogue fits, the answer is &lt;i&gt;unknown&lt;/i&gt;, and that is an answer.</source>
        <translation>Passt nichts aus dem Katalog, lautet die Antwort &lt;i&gt;unbekannt&lt;/i&gt;, und auch das ist eine Antwort.</translation>
    </message>
    <message>
        <source>If the instrument was warm already, say so: the report tells on what it rests.</source>
        <translation>War das Messgerät bereits warm, dies angeben: Der Bericht nennt, worauf er sich stützt.</translation>
    </message>
    <message>
        <source>It turns outdated when anything it tells has changed; write it again then.</source>
        <translation>Er veraltet, sobald sich etwas ändert, das er enthält; dann neu schreiben.</translation>
    </message>
    <message>
        <source>Jogs: what the instrument reads beside a commanded step must stay within one resolution of the axis.</source>
        <translation>Tippschritte: Die Abweichung der Anzeige vom Sollschritt muss innerhalb einer Auflösung der Achse bleiben.</translation>
    </message>
    <message>
        <source>Log when the control compensates (compensation_on): such data must not enter a fit unnoticed.</source>
        <translation>Protokollieren, wann die Steuerung kompensiert (compensation_on): Solche Daten dürfen nicht unbemerkt in eine Anpassung eingehen.</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Machines stand in the order in which they are due. The interval is what &lt;i&gt;plant event --every-days&lt;/i&gt; said, else what was usual so far.</source>
        <translation>Maschinen stehen in der Reihenfolge ihrer Fälligkeit. Das Intervall ist das mit &lt;i&gt;plant event --every-days&lt;/i&gt; angegebene, sonst das bisher übliche.</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Nine parameters: three displacements, three rotations, squareness, expansion of X and Y.</source>
        <translation>Neun Parameter: drei Verlagerungen, drei Drehungen, Rechtwinkligkeitsabweichung, Ausdehnung von X und Y.</translation>
    </message>
    <message>
        <source>Of a log: the tab &lt;i&gt;Live&lt;/i&gt; shows what the compensator predicts beside what is measured now; nothing is sent to the machine.</source>
        <translation>Bei einem Protokoll: Der Reiter &lt;i&gt;Live&lt;/i&gt; zeigt die Vorhersage des Kompensators neben der aktuellen Messung; an die Maschine wird nichts gesendet.</translation>
    </message>
    <message>
        <source>On a cluster: &lt;tt&gt;spindrift-cli batch PLAN.json --engine slurm --wait&lt;/tt&gt;. &lt;i&gt;Nobody&lt;/i&gt; under &lt;i&gt;Running&lt;/i&gt; means that the batch waits in Slurm or that Slurm has lost it; &lt;tt&gt;spindrift-cli batch status&lt;/tt&gt; says which, and &lt;tt&gt;batch resume --engine slurm&lt;/tt&gt; gives it what is missing.</source>
        <translation>Auf einem Cluster: &lt;tt&gt;spindrift-cli batch PLAN.json --engine slurm --wait&lt;/tt&gt;. &lt;i&gt;Niemand&lt;/i&gt; unter &lt;i&gt;Laufend&lt;/i&gt; bedeutet, dass der Batch-Auftrag in Slurm wartet oder dass Slurm ihn verloren hat; &lt;tt&gt;spindrift-cli batch status&lt;/tt&gt; sagt, was zutrifft, und &lt;tt&gt;batch resume --engine slurm&lt;/tt&gt; reicht das Fehlende nach.</translation>
    </message>
    <message>
        <source>On paper: 10,000 machines, daily, ten years</source>
        <translation>Auf dem Papier: 10.000 Maschinen, täglich, zehn Jahre</translation>
    </message>
    <message>
        <source>One machine has 3,650 campaigns, fourteen times as many as in five years of weeks. They are found by machine and time, whatever else is in the store; a trend of them takes fourteen times as long.</source>
        <translation>Eine Maschine hat 3.650 Kampagnen, vierzehnmal so viele wie bei wöchentlicher Messung in fünf Jahren. Sie werden über Maschine und Zeit gefunden, unabhängig vom übrigen Inhalt des Speichers; ein Verlauf daraus dauert vierzehnmal so lange.</translation>
    </message>
    <message>
        <source>Open the store of your plant: a file, or the PostgreSQL server that your department has. Its password stands in the file that PGPASSFILE names, never in the address.</source>
        <translation>Den Speicher des Werks öffnen: eine Datei oder den PostgreSQL-Server der Abteilung. Sein Passwort steht in der Datei, die PGPASSFILE nennt, nie in der Adresse.</translation>
    </message>
    <message>
        <source>Over time (touches, logs): a transfer function from speeds and temperatures to the deviation, always predicted freely, never one step ahead.</source>
        <translation>Über der Zeit (Antastungen, Protokolle): eine Übertragungsfunktion von Drehzahlen und Temperaturen auf die Abweichung, immer im freien Lauf vorhergesagt, nie nur einen Schritt voraus.</translation>
    </message>
    <message>
        <source>Plant</source>
        <translation>Werk</translation>
    </message>
    <message>
        <source>Put at least &lt;b&gt;6&lt;/b&gt; points over the whole table; &lt;i&gt;Suggest points&lt;/i&gt; places them where the nine parameters become surest.</source>
        <translation>Mindestens &lt;b&gt;6&lt;/b&gt; Punkte über den ganzen Tisch verteilen; &lt;i&gt;Punkte vorschlagen&lt;/i&gt; setzt sie dorthin, wo die neun Parameter am sichersten bestimmt werden.</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Review</source>
        <translation>Durchsicht</translation>
    </message>
    <message>
        <source>SQLite: one writer at a time. Some 50 machines and a few people are what it is for.</source>
        <translation>SQLite: ein Schreibzugriff zur gleichen Zeit. Gedacht für etwa 50 Maschinen und wenige Anwender.</translation>
    </message>
    <message>
        <source>Select several machines to lay their trends over each other. Check campaigns, of whatever session and machine, to see them side by side.</source>
        <translation>Mehrere Maschinen auswählen, um ihre Verläufe übereinanderzulegen. Kampagnen ankreuzen, gleich welcher Sitzung und Maschine, um sie nebeneinander zu sehen.</translation>
    </message>
    <message>
        <source>Set the goal first; it stays with the session. Between the two limits the measurement cannot decide: measure more often, or with less uncertainty (ISO 14253-1).</source>
        <translation>Zuerst das Ziel festlegen; es bleibt bei der Sitzung. Zwischen den beiden Grenzen kann die Messung nicht entscheiden: häufiger oder mit kleinerer Messunsicherheit messen (ISO 14253-1).</translation>
    </message>
    <message>
        <source>States are compared in their order: warm up and measure as you did before.</source>
        <translation>Zustände werden in ihrer Reihenfolge verglichen: warmfahren und messen wie zuvor.</translation>
    </message>
    <message>
        <source>Striped areas of the map lie outside the measured points; faded ones are within two standard uncertainties of zero.</source>
        <translation>Schraffierte Bereiche der Karte liegen außerhalb der gemessenen Punkte; blasse liegen innerhalb von zwei Standardunsicherheiten um null.</translation>
    </message>
    <message>
        <source>The first to break is what reads all campaigns: the list without a machine (0.2 s for 14,000; ten minutes for all) and the list of machines, which reads every start (0.03 s for 14,000; more than a minute for all). From about 300,000 campaigns on, name the machine, and keep the last start of each machine in its row.</source>
        <translation>Als Erstes versagt, was alle Kampagnen liest: die Liste ohne Maschine (0,2 s für 14.000; zehn Minuten für alle) und die Liste der Maschinen, die jeden Beginn liest (0,03 s für 14.000; über eine Minute für alle). Ab etwa 300.000 Kampagnen die Maschine nennen und den letzten Beginn jeder Maschine in ihrer Zeile führen.</translation>
    </message>
    <message>
        <source>The log marks the time with compensation_on; such readings enter no fit of the machine&apos;s own errors.</source>
        <translation>Das Protokoll kennzeichnet die Zeit mit compensation_on; solche Messwerte gehen in keine Anpassung der Abweichungen der Maschine selbst ein.</translation>
    </message>
    <message>
        <source>The observations of one state become a model of the machine; the points you leave out of the fit say whether to believe it.</source>
        <translation>Aus den Beobachtungen eines Zustands wird ein Modell der Maschine; die nicht zur Anpassung verwendeten Punkte zeigen, ob man ihm glauben kann.</translation>
    </message>
    <message>
        <source>The same plan, measured again while the control compensates: is the residual within the goal?</source>
        <translation>Derselbe Plan, erneut gemessen, während die Steuerung kompensiert: Liegt das Residuum innerhalb des Ziels?</translation>
    </message>
    <message>
        <source>The second is the list of files: a campaign of 100 images has 100 rows in it, 0.9 billion a year. Such plants publish one fingerprint a campaign.</source>
        <translation>Als Zweites die Liste der Dateien: Eine Kampagne mit 100 Bildern hat darin 100 Zeilen, 0,9 Milliarden im Jahr. Solche Werke veröffentlichen einen Fingerabdruck je Kampagne.</translation>
    </message>
    <message>
        <source>The slider goes through the thermal states; Play runs through them.</source>
        <translation>Der Schieber geht durch die thermischen Zustände; „Zustände abspielen“ durchläuft sie.</translation>
    </message>
    <message>
        <source>The third is upkeep: from some 10 million campaigns on, partition result, parameter and capture by the year in which they were published (ten partitions of about 7 GB), so that a year is vacuumed, backed up and taken away by itself. The unique keys then need the year in them; this has not been tried.</source>
        <translation>Als Drittes die Pflege: Ab etwa 10 Millionen Kampagnen result, parameter und capture nach dem Jahr der Veröffentlichung partitionieren (zehn Partitionen zu etwa 7 GB), damit sich ein Jahr für sich bereinigen, sichern und entfernen lässt. Die eindeutigen Schlüssel brauchen dann das Jahr; dies wurde nicht erprobt.</translation>
    </message>
    <message>
        <source>Turn one view and the others follow. Faded: within two standard uncertainties of zero; striped: outside the points that were measured.</source>
        <translation>Dreht man eine Ansicht, folgen die anderen. Verblasst: innerhalb von zwei Standardunsicherheiten um null; gestreift: außerhalb der gemessenen Punkte.</translation>
    </message>
    <message>
        <source>Two to four panes side by side: states, models, campaigns and scans under one camera and one colour scale.</source>
        <translation>Zwei bis vier Bereiche nebeneinander: Zustände, Modelle, Kampagnen und Scans mit gemeinsamer Kamera und Farbskala.</translation>
    </message>
    <message>
        <source>Verify</source>
        <translation>Verifizieren</translation>
    </message>
    <message>
        <source>Warm-up</source>
        <translation>Warmlauf</translation>
    </message>
    <message>
        <source>What the control shall add at each point, and the error that is left when it does.</source>
        <translation>Was die Steuerung an jedem Punkt aufschalten soll und welche Abweichung dann verbleibt.</translation>
    </message>
    <message>
        <source>What the discrepancy step names is added only after you have ticked it (plan: &lt;i&gt;&quot;accept&quot;: &quot;ask&quot;&lt;/i&gt;).</source>
        <translation>Was der Schritt Diskrepanz benennt, wird erst hinzugefügt, wenn Sie es angekreuzt haben (Plan: &lt;i&gt;&quot;accept&quot;: &quot;ask&quot;&lt;/i&gt;).</translation>
    </message>
    <message>
        <source>Where measurement and simulation disagree, the search tries every effect of the catalogue and names the one that explains the gap, with its rivals.</source>
        <translation>Wo Messung und Simulation voneinander abweichen, erprobt die Suche jeden Effekt des Katalogs und benennt den, der die Differenz erklärt, mit seinen konkurrierenden Erklärungen.</translation>
    </message>
    <message>
        <source>Which machine is to be measured next, what has changed on it, and does its model still hold?</source>
        <translation>Welche Maschine ist als Nächstes zu messen, was hat sich an ihr geändert, und gilt ihr Modell noch?</translation>
    </message>
    <message>
        <source>While something is connected (Machine, Connections), temperatures are shown as they come.</source>
        <translation>Solange etwas verbunden ist (Maschine, Verbindungen), werden Temperaturen laufend angezeigt.</translation>
    </message>
    <message>
        <source>With a connected spindle speed or feed the page says when the machine stands still; wait for that.</source>
        <translation>Sind Spindeldrehzahl oder Vorschub verbunden, zeigt die Seite, wann die Maschine stillsteht; darauf warten.</translation>
    </message>
    <message>
        <source>before</source>
        <translation>vorher</translation>
    </message>
    <message>
        <source>campaign</source>
        <translation>Kampagne</translation>
    </message>
    <message>
        <source>capture (one file each)</source>
        <translation>Aufnahme (je eine Datei)</translation>
    </message>
    <message>
        <source>centre of rotation</source>
        <translation>Drehmittelpunkt</translation>
    </message>
    <message>
        <source>cold</source>
        <translation>kalt</translation>
    </message>
    <message>
        <source>compensated</source>
        <translation>kompensiert</translation>
    </message>
    <message>
        <source>correction = - deviation</source>
        <translation>Korrektur = − Abweichung</translation>
    </message>
    <message>
        <source>deviation</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>focus height</source>
        <translation>Fokushöhe</translation>
    </message>
    <message>
        <source>gap</source>
        <translation>Differenz</translation>
    </message>
    <message>
        <source>goal</source>
        <translation>Ziel</translation>
    </message>
    <message>
        <source>image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>measured points and fitted table</source>
        <translation>gemessene Punkte und angepasster Tisch</translation>
    </message>
    <message>
        <source>parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>scan</source>
        <translation>Scan</translation>
    </message>
    <message>
        <source>settled</source>
        <translation>eingelaufen</translation>
    </message>
    <message>
        <source>signed</source>
        <translation>unterschrieben</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>simuliert</translation>
    </message>
    <message>
        <source>time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>together</source>
        <translation>zusammen</translation>
    </message>
    <message>
        <source>tool</source>
        <translation>Werkzeug</translation>
    </message>
    <message>
        <source>touch</source>
        <translation>Antastung</translation>
    </message>
    <message>
        <source>warm</source>
        <translation>warm</translation>
    </message>
    <message>
        <source>workpiece</source>
        <translation>Werkstück</translation>
    </message>
    <message>
        <source>&lt;i&gt;Connections&lt;/i&gt;: enter an address (http, mqtt, modbus, serial, linuxcnc, genicam …), see what is there, tick what becomes a column of log.csv. &lt;i&gt;Live view&lt;/i&gt; writes nothing; &lt;i&gt;Record&lt;/i&gt; goes on while you leave the page. Machines are only read. Passwords stand in the environment or in a file of yours, never in the session.</source>
        <translation>&lt;i&gt;Verbindungen&lt;/i&gt;: eine Adresse eingeben (http, mqtt, modbus, serial, linuxcnc, genicam …), ansehen, was es dort gibt, und ankreuzen, was eine Spalte von log.csv wird. &lt;i&gt;Live-Ansicht&lt;/i&gt; schreibt nichts; &lt;i&gt;Aufzeichnen&lt;/i&gt; läuft weiter, wenn Sie die Seite verlassen. Maschinen werden nur gelesen. Passwörter stehen in der Umgebung oder in einer eigenen Datei, nie in der Sitzung.</translation>
    </message>
    <message>
        <source>Measured with 14,000 campaigns on PostgreSQL 15, each with one fit of nine parameters, its covariance and one file: 2.2 kB a campaign (campaign 0.21, files 0.23, result 0.81, parameters 0.93 kB, indexes among them); SQLite 1.6 kB. The following figures are calculated from that.</source>
        <translation>Gemessen mit 14.000 Kampagnen auf PostgreSQL 15, jede mit einer Anpassung von neun Parametern, ihrer Kovarianz und einer Datei: 2,2 kB je Kampagne (Kampagne 0,21, Dateien 0,23, Ergebnis 0,81, Parameter 0,93 kB, einschließlich Indizes); SQLite 1,6 kB. Die folgenden Zahlen sind daraus berechnet.</translation>
    </message>
    <message>
        <source>An instrument that is still warming up measures itself. Measure one point every 5 minutes, then press &lt;b&gt;Check the drift&lt;/b&gt;: its fit says whether the instrument has settled.</source>
        <translation>Ein Messgerät, das noch warm wird, misst sich selbst. Alle 5 Minuten einen Punkt messen, dann &lt;b&gt;Drift prüfen&lt;/b&gt; drücken: ihre Anpassung sagt, ob das Messgerät eingelaufen ist.</translation>
    </message>
    <message>
        <source>Fanuc: public documents do not say which way a positive value of the pitch error data moves the axis. Try it once, as the choice &lt;i&gt;Fanuc&lt;/i&gt; describes, and state it; then the data are written.</source>
        <translation>Fanuc: Öffentliche Unterlagen sagen nicht, wohin ein positiver Wert der Steigungsfehlerdaten die Achse bewegt. Einmal ausprobieren, wie es die Auswahl &lt;i&gt;Fanuc&lt;/i&gt; beschreibt, und angeben; dann werden die Daten geschrieben.</translation>
    </message>
    <message>
        <source>Heidenhain: the values are entered in the control&apos;s table editor; the layout of its files is not public.</source>
        <translation>Heidenhain: Die Werte werden im Tabelleneditor der Steuerung eingegeben; der Aufbau ihrer Dateien ist nicht öffentlich.</translation>
    </message>
    <message>
        <source>Tables stand in place of those that the control has: save these first, and add them where they are to hold.</source>
        <translation>Tabellen stehen anstelle derer, die die Steuerung hat: diese zuerst sichern und dazuzählen, wo sie gelten sollen.</translation>
    </message>
</context>
<context>
    <name>main</name>
    <message>
        <source>A session or a campaign to open.</source>
        <translation>Sitzung oder Kampagne, die geöffnet wird.</translation>
    </message>
    <message>
        <source>Internal error, please report it: %1</source>
        <translation>Interner Fehler, bitte melden: %1</translation>
    </message>
    <message>
        <source>Spindrift: measure, understand and compensate the thermal errors of machine tools.</source>
        <translation>Spindrift: thermische Abweichungen von Werkzeugmaschinen messen, verstehen und kompensieren.</translation>
    </message>
    <message>
        <source>Walk through every step on demo data and save pictures in DIR.</source>
        <translation>Alle Schritte mit Demodaten durchlaufen und Bilder in DIR speichern.</translation>
    </message>
    <message>
        <source>light or dark.</source>
        <translation>light (hell) oder dark (dunkel).</translation>
    </message>
    <message>
        <source>Language of the window; otherwise that of the preferences or the system.</source>
        <translation>Sprache des Fensters; sonst die der Einstellungen oder des Systems.</translation>
    </message>
    <message>
        <source>Scale of everything, 0.5 to 4.</source>
        <translation>Skalierung der gesamten Oberfläche, 0.5 bis 4.</translation>
    </message>
    <message>
        <source>Run all demos and compare their results with the known truth: pass or fail for each.</source>
        <translation>Alle Demos ausführen und ihre Ergebnisse mit der bekannten Wahrheit vergleichen: bestanden oder nicht bestanden.</translation>
    </message>
    <message>
        <source>With --self-test: write the result to FILE, or to standard output with -.</source>
        <translation>Mit --self-test: Ergebnis in FILE schreiben, mit - auf die Standardausgabe.</translation>
    </message>
    <message>
        <source>Print how long it takes to the first usable window, and end.</source>
        <translation>Ausgeben, wie lange es bis zum ersten bedienbaren Fenster dauert, und beenden.</translation>
    </message>
    <message>
        <source>Print the reference of the options: a man page, the completion of bash, or Markdown.</source>
        <translation>Referenz der Optionen ausgeben: Handbuchseite (man), Vervollständigung für bash oder Markdown.</translation>
    </message>
    <message>
        <source>With --tour: size of the window; every page with each of its tabs is shown.</source>
        <translation>Mit --tour: Größe des Fensters; jede Seite wird mit allen Reitern gezeigt.</translation>
    </message>
    <message>
        <source>Open a demo session of the virtual machine; its name may follow: fiducials, holes, balls, scans, discrepancy, own_pattern.</source>
        <translation>Eine Demositzung der virtuellen Maschine öffnen; ihr Name kann folgen: fiducials, holes, balls, scans, discrepancy, own_pattern.</translation>
    </message>
    <message>
        <source>Write what is done at the window, with what is typed, to FILE, so that others can do it again (JSON).</source>
        <translation>Nach FILE schreiben, was am Fenster getan und eingegeben wird, sodass andere es wiederholen können (JSON).</translation>
    </message>
</context>
<context>
    <name>measurement</name>
    <message>
        <source>%1 to %2</source>
        <translation>%1 bis %2</translation>
    </message>
    <message>
        <source>%1: %2 mm</source>
        <translation>%1: %2 mm</translation>
    </message>
    <message>
        <source>%1: %2, %3 %4 than nominal</source>
        <translation>%1: %2, %3 %4 als das Nennmaß</translation>
    </message>
    <message>
        <source>less</source>
        <translation>weniger</translation>
    </message>
    <message>
        <source>more</source>
        <translation>mehr</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>Fläche</translation>
    </message>
</context>
<context>
    <name>profileSeries</name>
    <message>
        <source>Cold</source>
        <translation>Kalt</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>Ausgelassen</translation>
    </message>
    <message>
        <source>This scan</source>
        <translation>Dieser Scan</translation>
    </message>
</context>
<context>
    <name>spindrift::gui</name>
    <message>
        <source>Captures</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>Arriving</source>
        <translation>Eingang</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>User</source>
        <translation>Benutzer</translation>
    </message>
    <message>
        <source>Variable with the password</source>
        <translation>Variable mit dem Passwort</translation>
    </message>
    <message>
        <source>name of a variable of the environment</source>
        <translation>Name einer Umgebungsvariablen</translation>
    </message>
    <message>
        <source>File with the password</source>
        <translation>Datei mit dem Passwort</translation>
    </message>
    <message>
        <source>readable by its owner only</source>
        <translation>nur für den Eigentümer lesbar</translation>
    </message>
    <message>
        <source>Certificates</source>
        <translation>Zertifikate</translation>
    </message>
    <message>
        <source>file with those that are trusted</source>
        <translation>Datei mit den vertrauenswürdigen Zertifikaten</translation>
    </message>
    <message>
        <source>Name of this client</source>
        <translation>Name dieses Clients</translation>
    </message>
    <message>
        <source>with one, nothing is missed while it is away</source>
        <translation>mit Namen geht nichts verloren, solange er getrennt ist</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>1</source>
        <translation>1</translation>
    </message>
    <message>
        <source>Read every / s</source>
        <translation>Abfrage alle / s</translation>
    </message>
    <message>
        <source>Stream every / s</source>
        <translation>Senden alle / s</translation>
    </message>
    <message>
        <source>of linuxcncrsh; name of a variable of the environment</source>
        <translation>von linuxcncrsh; Name einer Umgebungsvariablen</translation>
    </message>
    <message>
        <source>Exposure / µs</source>
        <translation>Belichtung / µs</translation>
    </message>
    <message>
        <source>as the camera has it</source>
        <translation>wie in der Kamera eingestellt</translation>
    </message>
    <message>
        <source>Gain</source>
        <translation>Verstärkung</translation>
    </message>
    <message>
        <source>in the unit of the camera, mostly dB</source>
        <translation>in der Einheit der Kamera, meist dB</translation>
    </message>
    <message>
        <source>Trigger</source>
        <translation>Auslöser</translation>
    </message>
    <message>
        <source>none; Software, Line1 …</source>
        <translation>none; Software, Line1 …</translation>
    </message>
    <message>
        <source>Region</source>
        <translation>Bereich</translation>
    </message>
    <message>
        <source>x, y, width, height in pixels</source>
        <translation>x, y, Breite, Höhe in Pixeln</translation>
    </message>
    <message>
        <source>Pattern of a line</source>
        <translation>Muster einer Zeile</translation>
    </message>
    <message>
        <source>T1={column} T2={bed}</source>
        <translation>T1={column} T2={bed}</translation>
    </message>
    <message>
        <source>Append every line to</source>
        <translation>Jede Zeile anhängen an</translation>
    </message>
    <message>
        <source>file, for printed touches</source>
        <translation>Datei, für gedruckte Antastungen</translation>
    </message>
    <message>
        <source>Baud</source>
        <translation>Baudrate</translation>
    </message>
    <message>
        <source>9600</source>
        <translation>9600</translation>
    </message>
    <message>
        <source>Parity</source>
        <translation>Parität</translation>
    </message>
    <message>
        <source>none, even or odd</source>
        <translation>none, even oder odd</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ActivityDialog</name>
    <message>
        <source>Jobs and messages</source>
        <translation>Aufträge und Meldungen</translation>
    </message>
    <message>
        <source>Running and waiting</source>
        <translation>Laufend und wartend</translation>
    </message>
    <message>
        <source>Job</source>
        <translation>Auftrag</translation>
    </message>
    <message>
        <source>Jobs</source>
        <translation>Aufträge</translation>
    </message>
    <message>
        <source>Cancel the job</source>
        <translation>Auftrag abbrechen</translation>
    </message>
    <message>
        <source>Stop it, or take it out before it begins; nothing of it is applied</source>
        <translation>Anhalten oder vor dem Beginn herausnehmen; nichts davon wird übernommen</translation>
    </message>
    <message>
        <source>Messages</source>
        <translation>Meldungen</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Zeitpunkt</translation>
    </message>
    <message>
        <source>Message</source>
        <translation>Meldung</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>waits</source>
        <translation>wartet</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Fortschritt</translation>
    </message>
    <message>
        <source>No job is running.</source>
        <translation>Es läuft nichts.</translation>
    </message>
    <message>
        <source>There are no messages yet.</source>
        <translation>Noch keine Meldungen.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ArrivingPanel</name>
    <message>
        <source>waiting</source>
        <translation>wartend</translation>
    </message>
    <message>
        <source>accepted</source>
        <translation>angenommen</translation>
    </message>
    <message>
        <source>take again</source>
        <translation>wiederholen</translation>
    </message>
    <message>
        <source>twice</source>
        <translation>doppelt</translation>
    </message>
    <message>
        <source>left aside</source>
        <translation>beiseitegelegt</translation>
    </message>
    <message>
        <source>Watch folder …</source>
        <translation>Ordner überwachen …</translation>
    </message>
    <message>
        <source>Every image, list of touches and cloud that appears in the folder is checked at once</source>
        <translation>Jedes Bild, jede Antastliste und jede Punktwolke, die im Ordner erscheint, wird sofort geprüft</translation>
    </message>
    <message>
        <source>Printed text …</source>
        <translation>Gedruckter Text …</translation>
    </message>
    <message>
        <source>Template that reads the text which the control prints (.txt, .log, .prn)</source>
        <translation>Vorlage, nach der der von der Steuerung gedruckte Text (.txt, .log, .prn) gelesen wird</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Arrived</source>
        <translation>Eingegangen</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Capture</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>What was found</source>
        <translation>Befund</translation>
    </message>
    <message>
        <source>Files that arrived</source>
        <translation>Eingegangene Dateien</translation>
    </message>
    <message>
        <source>Files appear here as they arrive in the watched folder.</source>
        <translation>Hier erscheinen die Dateien, sobald sie im überwachten Ordner eintreffen.</translation>
    </message>
    <message>
        <source>Touches as they come in</source>
        <translation>Antastungen beim Eintreffen</translation>
    </message>
    <message>
        <source>Plan</source>
        <translation>Plan</translation>
    </message>
    <message>
        <source>Folder into which the instrument writes</source>
        <translation>Ordner, in den das Messgerät schreibt</translation>
    </message>
    <message>
        <source>Template of what the control prints</source>
        <translation>Vorlage für den Druck der Steuerung</translation>
    </message>
    <message>
        <source>Template (*.json)</source>
        <translation>Vorlage (*.json)</translation>
    </message>
    <message>
        <source>Machine: %1</source>
        <translation>Maschine: %1</translation>
    </message>
    <message>
        <source>Not watching. The last folder was %1; what arrived meanwhile is found when it is watched again.</source>
        <translation>Keine Überwachung. Der letzte Ordner war %1; was inzwischen eingegangen ist, wird bei erneuter Überwachung gefunden.</translation>
    </message>
    <message>
        <source>Choose the folder into which the instrument writes. Every file is checked as it arrives and copied into the session.</source>
        <translation>Ordner wählen, in den das Messgerät schreibt. Jede Datei wird beim Eintreffen geprüft und in die Sitzung kopiert.</translation>
    </message>
    <message>
        <source> And %1 more.</source>
        <translation> Und %1 weitere.</translation>
    </message>
    <message numerus="yes">
        <source>Watching %1: %n files, %2 accepted. Capturing goes on when this page is left.</source>
        <translation>
            <numerusform>Überwacht wird %1: %n Datei, %2 angenommen. Die Aufnahme läuft weiter, wenn diese Seite verlassen wird.</numerusform>
            <numerusform>Überwacht wird %1: %n Dateien, %2 angenommen. Die Aufnahme läuft weiter, wenn diese Seite verlassen wird.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ArtefactDesigner</name>
    <message>
        <source>free</source>
        <translation>frei</translation>
    </message>
    <message>
        <source>Artefact designer</source>
        <translation>Prüfkörper-Entwurf</translation>
    </message>
    <message>
        <source>A free-form surface for the laser profiler: see what a scan of it can tell before it is milled or printed.</source>
        <translation>Freiformfläche für den Laser-Profilsensor: zeigt, was ein Scan davon aussagen kann, bevor sie gefräst oder gedruckt wird.</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>The paper&apos;s surface</source>
        <translation>Fläche der Veröffentlichung</translation>
    </message>
    <message>
        <source>With two bumps (unique)</source>
        <translation>Mit zwei Höckern (eindeutig)</translation>
    </message>
    <message>
        <source>Crossed waves</source>
        <translation>Gekreuzte Wellen</translation>
    </message>
    <message>
        <source>Wide and calm</source>
        <translation>Weit und flach</translation>
    </message>
    <message>
        <source>Surface to start from</source>
        <translation>Ausgangsfläche</translation>
    </message>
    <message>
        <source>Size X</source>
        <translation>Länge in X</translation>
    </message>
    <message>
        <source>Size Y, along the scan</source>
        <translation>Länge in Y, in Scanrichtung</translation>
    </message>
    <message>
        <source>Wave along X, amplitude</source>
        <translation>Welle entlang X, Amplitude</translation>
    </message>
    <message>
        <source>Wave along X</source>
        <translation>Welle entlang X</translation>
    </message>
    <message>
        <source>Wave along Y, amplitude</source>
        <translation>Welle entlang Y, Amplitude</translation>
    </message>
    <message>
        <source>Wave along Y</source>
        <translation>Welle entlang Y</translation>
    </message>
    <message>
        <source>Oblique wave, amplitude</source>
        <translation>Schräge Welle, Amplitude</translation>
    </message>
    <message>
        <source>Noise of a point</source>
        <translation>Rauschen eines Punktes</translation>
    </message>
    <message>
        <source>Points of a scan</source>
        <translation>Punkte je Scan</translation>
    </message>
    <message>
        <source>Steepest slope seen</source>
        <translation>Größte erfasste Steigung</translation>
    </message>
    <message>
        <source>Base under the lowest point</source>
        <translation>Sockel unter dem tiefsten Punkt</translation>
    </message>
    <message>
        <source>Facets of the STL</source>
        <translation>Facetten der STL-Datei</translation>
    </message>
    <message>
        <source>Save as STL …</source>
        <translation>Als STL speichern …</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>Slope against the limit</source>
        <translation>Steigung bezogen auf die Grenze</translation>
    </message>
    <message>
        <source>Colours of the surface</source>
        <translation>Farben der Fläche</translation>
    </message>
    <message>
        <source>Uncertainty of</source>
        <translation>Unsicherheit von</translation>
    </message>
    <message>
        <source>rigid</source>
        <translation>starr</translation>
    </message>
    <message>
        <source>push broom</source>
        <translation>zeilenweise</translation>
    </message>
    <message>
        <source>Scan model</source>
        <translation>Scanmodell</translation>
    </message>
    <message>
        <source>Weak direction</source>
        <translation>Schwache Richtung</translation>
    </message>
    <message>
        <source>Known to / µm</source>
        <translation>Bekannt auf / µm</translation>
    </message>
    <message>
        <source>Weak directions</source>
        <translation>Schwache Richtungen</translation>
    </message>
    <message>
        <source>No direction is weak.</source>
        <translation>Keine Richtung ist schwach bestimmt.</translation>
    </message>
    <message>
        <source>Directions of the motion that are known thirty times less well than the best one; rotations times the artefact&apos;s length</source>
        <translation>Bewegungsrichtungen, die mehr als dreißigmal ungenauer bekannt sind als die beste; Drehungen mal Länge des Prüfkörpers</translation>
    </message>
    <message>
        <source>Standard uncertainty of the six errors</source>
        <translation>Standardunsicherheit der sechs Abweichungen</translation>
    </message>
    <message>
        <source>not determined</source>
        <translation>nicht bestimmt</translation>
    </message>
    <message>
        <source>Slope up to %1 along X and %2 along Y.</source>
        <translation>Steigung bis %1 entlang X und %2 entlang Y.</translation>
    </message>
    <message>
        <source>%1 The profiler sees only %2 % of the surface; the rest is too steep (red).</source>
        <translation>%1 Der Profilsensor sieht nur %2 % der Fläche; der Rest ist zu steil (rot).</translation>
    </message>
    <message>
        <source>The profiler sees all of it.</source>
        <translation>Der Profilsensor sieht die gesamte Fläche.</translation>
    </message>
    <message>
        <source>over the limit</source>
        <translation>über der Grenze</translation>
    </message>
    <message>
        <source>z</source>
        <translation>z</translation>
    </message>
    <message>
        <source>Red: steeper than the profiler sees</source>
        <translation>Rot: steiler, als der Profilsensor erfasst</translation>
    </message>
    <message>
        <source>Height of the surface</source>
        <translation>Höhe der Fläche</translation>
    </message>
    <message>
        <source>Save the artefact</source>
        <translation>Prüfkörper speichern</translation>
    </message>
    <message>
        <source>STL, mm (*.stl)</source>
        <translation>STL, mm (*.stl)</translation>
    </message>
    <message>
        <source>Saved as %1.</source>
        <translation>Gespeichert als %1.</translation>
    </message>
    <message>
        <source>thousand</source>
        <translation>Tausend</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ArtefactEditor</name>
    <message>
        <source>Artefact</source>
        <translation>Prüfkörper</translation>
    </message>
    <message>
        <source>Hole bar</source>
        <translation>Lochleiste</translation>
    </message>
    <message>
        <source>Balls</source>
        <translation>Kugeln</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>How it looks</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>The artefact will appear here</source>
        <translation>Hier erscheint der Prüfkörper</translation>
    </message>
    <message>
        <source>Add a hole bar or balls, and type their certificate.</source>
        <translation>Lochleiste oder Kugeln hinzufügen und den Kalibrierschein eintragen.</translation>
    </message>
    <message>
        <source>Styli</source>
        <translation>Tastereinsätze</translation>
    </message>
    <message>
        <source>Stylus</source>
        <translation>Taster-
einsatz</translation>
    </message>
    <message>
        <source>x / mm</source>
        <translation>x / mm</translation>
    </message>
    <message>
        <source>y / mm</source>
        <translation>y / mm</translation>
    </message>
    <message>
        <source>z / mm</source>
        <translation>z / mm</translation>
    </message>
    <message>
        <source>Offset: tip minus spindle reference</source>
        <translation>Versatz: Tastkugel minus Spindelreferenz</translation>
    </message>
    <message>
        <source>Add stylus</source>
        <translation>Tastereinsatz hinzufügen</translation>
    </message>
    <message>
        <source>Remove stylus</source>
        <translation>Tastereinsatz entfernen</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Apply artefacts</source>
        <translation>Prüfkörper übernehmen</translation>
    </message>
    <message>
        <source>The machine has no artefact yet. A touch probe needs one and its styli.</source>
        <translation>Die Maschine hat noch keinen Prüfkörper. Ein Messtaster braucht einen Prüfkörper und seine Tastereinsätze.</translation>
    </message>
    <message>
        <source> And %1 more: look for the marks.</source>
        <translation> Und %1 weitere: siehe die Markierungen.</translation>
    </message>
    <message>
        <source>As it was before the mistake</source>
        <translation>Wie vor dem Eingabefehler</translation>
    </message>
    <message>
        <source>remove an artefact</source>
        <translation>Prüfkörper entfernen</translation>
    </message>
    <message>
        <source>add a stylus</source>
        <translation>Tastereinsatz hinzufügen</translation>
    </message>
    <message>
        <source>remove a stylus</source>
        <translation>Tastereinsatz entfernen</translation>
    </message>
    <message>
        <source>add an artefact</source>
        <translation>Prüfkörper hinzufügen</translation>
    </message>
    <message>
        <source>change the artefacts</source>
        <translation>Prüfkörper ändern</translation>
    </message>
    <message>
        <source>Something was typed here for another state of the machine. Show it, or discard it.</source>
        <translation>Hier wurde etwas für einen anderen Stand der Maschine eingegeben. Anzeigen oder verwerfen.</translation>
    </message>
    <message>
        <source>Show it</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>Radius
/ mm</source>
        <translation>Radius
/ mm</translation>
    </message>
    <message>
        <source>No stylus yet.</source>
        <translation>Noch kein Tastereinsatz.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ArtefactFields</name>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>As the touches name it</source>
        <translation>Wie ihn die Antastungen nennen</translation>
    </message>
    <message>
        <source>Serial number</source>
        <translation>Seriennummer</translation>
    </message>
    <message>
        <source>Goes into the report</source>
        <translation>Steht im Bericht</translation>
    </message>
    <message>
        <source>Material</source>
        <translation>Werkstoff</translation>
    </message>
    <message>
        <source>Steel 11.5, Invar 1.2</source>
        <translation>Stahl 11,5; Invar 1,2</translation>
    </message>
    <message>
        <source>Temperature / °C</source>
        <translation>Temperatur / °C</translation>
    </message>
    <message>
        <source>Of the artefact, where no sensor says it</source>
        <translation>Des Prüfkörpers, sofern kein Sensor sie misst</translation>
    </message>
    <message>
        <source>Certificate ± / µm</source>
        <translation>Kalibrierschein ± / µm</translation>
    </message>
    <message>
        <source>Standard uncertainty of a certified position</source>
        <translation>Standardunsicherheit einer zertifizierten Position</translation>
    </message>
    <message>
        <source>Hole diameter / mm</source>
        <translation>Lochdurchmesser / mm</translation>
    </message>
    <message>
        <source>Reference hole</source>
        <translation>Referenzloch</translation>
    </message>
    <message>
        <source>H1, H2, …</source>
        <translation>H1, H2, …</translation>
    </message>
    <message>
        <source>Reference at / mm</source>
        <translation>Referenz bei / mm</translation>
    </message>
    <message>
        <source>x, y, z of the reference hole from the centre of the rotary axis at 0°</source>
        <translation>x, y, z des Referenzlochs vom Zentrum der Drehachse bei 0°</translation>
    </message>
    <message>
        <source>Direction at 0°</source>
        <translation>Richtung bei 0°</translation>
    </message>
    <message>
        <source>Along the bar, from H1 on</source>
        <translation>Entlang der Leiste, von H1 aus</translation>
    </message>
    <message>
        <source>Holes or balls</source>
        <translation>Löcher oder Kugeln</translation>
    </message>
    <message>
        <source>Add row</source>
        <translation>Zeile hinzufügen</translation>
    </message>
    <message>
        <source>Remove row</source>
        <translation>Zeile entfernen</translation>
    </message>
    <message>
        <source>Hole</source>
        <translation>Loch</translation>
    </message>
    <message>
        <source>Certified position along the bar / mm</source>
        <translation>Zertifizierte Position auf der Leiste / mm</translation>
    </message>
    <message>
        <source>Ball</source>
        <translation>Kugel</translation>
    </message>
    <message>
        <source>x / mm</source>
        <translation>x / mm</translation>
    </message>
    <message>
        <source>y / mm</source>
        <translation>y / mm</translation>
    </message>
    <message>
        <source>z / mm</source>
        <translation>z / mm</translation>
    </message>
    <message>
        <source>Ø / mm</source>
        <translation>Ø / mm</translation>
    </message>
    <message>
        <source>Apart / mm</source>
        <translation>Abstand / mm</translation>
    </message>
    <message>
        <source>Distance from the first ball</source>
        <translation>Abstand von der ersten Kugel</translation>
    </message>
    <message>
        <source>Expansion / (µm/(m·K))</source>
        <translation>Ausdehnung / (µm/(m·K))</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::AxisErrorsPage</name>
    <message>
        <source>See the six errors of the axis over positions and time, and which of them the scans can show.</source>
        <translation>Sechs Abweichungen der Achse über Position und Zeit, und welche davon die Scans zeigen können.</translation>
    </message>
    <message>
        <source>Find the six errors</source>
        <translation>Sechs Abweichungen bestimmen</translation>
    </message>
    <message>
        <source>Error of the axis</source>
        <translation>Abweichung der Achse</translation>
    </message>
    <message>
        <source>Rigid</source>
        <translation>Starr</translation>
    </message>
    <message>
        <source>Push broom</source>
        <translation>Zeilenweise</translation>
    </message>
    <message>
        <source>Scan model</source>
        <translation>Scanmodell</translation>
    </message>
    <message>
        <source>The cloud moves as one body</source>
        <translation>Die Punktwolke bewegt sich als ein Körper</translation>
    </message>
    <message>
        <source>Every profile is taken at its own position of the carriage</source>
        <translation>Jedes Profil wird an seiner eigenen Position des Schlittens aufgenommen</translation>
    </message>
    <message>
        <source>At the slide&apos;s origin</source>
        <translation>Am Ursprung des Schlittens</translation>
    </message>
    <message>
        <source>Over time</source>
        <translation>Über der Zeit</translation>
    </message>
    <message>
        <source>Over position</source>
        <translation>Über der Position</translation>
    </message>
    <message>
        <source>Horizontal axis</source>
        <translation>Waagerechte Achse</translation>
    </message>
    <message>
        <source>Time / min</source>
        <translation>Zeit / min</translation>
    </message>
    <message>
        <source>EXY / µm</source>
        <translation>EXY / µm</translation>
    </message>
    <message>
        <source>Errors of the axis will appear here</source>
        <translation>Hier erscheinen die Abweichungen der Achse</translation>
    </message>
    <message>
        <source>Find the six errors: each is drawn over time with its uncertainty.</source>
        <translation>Sechs Abweichungen bestimmen: jede wird über der Zeit mit ihrer Unsicherheit dargestellt.</translation>
    </message>
    <message>
        <source>Scan</source>
        <translation>Scan</translation>
    </message>
    <message>
        <source>At the origin</source>
        <translation>Am Ursprung</translation>
    </message>
    <message>
        <source>At the artefact</source>
        <translation>Am Prüfkörper</translation>
    </message>
    <message>
        <source>Observed</source>
        <translation>Beobachtbar</translation>
    </message>
    <message>
        <source>Values</source>
        <translation>Werte</translation>
    </message>
    <message>
        <source>Every scan&apos;s error with its uncertainty appears here.</source>
        <translation>Hier erscheint jede Abweichung eines Scans mit ihrer Unsicherheit.</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>Abweichung</translation>
    </message>
    <message>
        <source>± at the origin</source>
        <translation>± am Ursprung</translation>
    </message>
    <message>
        <source>± at the artefact</source>
        <translation>± am Prüfkörper</translation>
    </message>
    <message>
        <source>Observable</source>
        <translation>Beobachtbar</translation>
    </message>
    <message>
        <source>What the scan model can observe</source>
        <translation>Was das Scanmodell beobachten kann</translation>
    </message>
    <message>
        <source>Which errors this scan model can show appears after the fit.</source>
        <translation>Welche Abweichungen dieses Scanmodell zeigen kann, erscheint nach der Anpassung.</translation>
    </message>
    <message>
        <source>Observability</source>
        <translation>Beobachtbarkeit</translation>
    </message>
    <message>
        <source>Over position and time</source>
        <translation>Über Position und Zeit</translation>
    </message>
    <message>
        <source>The surface will appear here</source>
        <translation>Hier erscheint die Fläche</translation>
    </message>
    <message>
        <source>It needs at least two positions and two times with a determined error.</source>
        <translation>Sie braucht mindestens zwei Positionen und zwei Zeitpunkte mit einer bestimmten Abweichung.</translation>
    </message>
    <message>
        <source>choose the scan model</source>
        <translation>Scanmodell wählen</translation>
    </message>
    <message>
        <source>Reading the six errors</source>
        <translation>Sechs Abweichungen werden gelesen</translation>
    </message>
    <message>
        <source>The scans are not evaluated yet.</source>
        <translation>Die Scans sind noch nicht ausgewertet.</translation>
    </message>
    <message>
        <source>Go to Calibrate</source>
        <translation>Zu „Kalibrieren“ wechseln</translation>
    </message>
    <message>
        <source>Press Find the six errors. They hold at the origin of the slide, far from the artefact: the levers of the machine carry the rotations there.</source>
        <translation>„Sechs Abweichungen bestimmen“ drücken. Sie gelten am Ursprung des Schlittens, weit vom Prüfkörper entfernt: die Hebelarme der Maschine übertragen die Drehungen dorthin.</translation>
    </message>
    <message>
        <source>Changed since: %1. Find the errors again.</source>
        <translation>Geändert seitdem: %1. Abweichungen erneut bestimmen.</translation>
    </message>
    <message>
        <source>The machine description says that its scans are %1. Under another scan model the numbers below are wrong by more than they say.</source>
        <translation>Laut Maschinenbeschreibung sind die Scans %1. Unter einem anderen Scanmodell sind die folgenden Zahlen um mehr falsch, als sie angeben.</translation>
    </message>
    <message>
        <source>%1 at %2 mm</source>
        <translation>%1 bei %2 mm</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>Position of the carriage / mm</source>
        <translation>Position des Schlittens / mm</translation>
    </message>
    <message>
        <source>%1 / %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>Position / mm</source>
        <translation>Position / mm</translation>
    </message>
    <message>
        <source>At the origin / %1</source>
        <translation>Am Ursprung / %1</translation>
    </message>
    <message>
        <source>At the artefact / %1</source>
        <translation>Am Prüfkörper / %1</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>no</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>in %1 of %2 scans</source>
        <translation>in %1 von %2 Scans</translation>
    </message>
    <message>
        <source>Errors of the axis</source>
        <translation>Abweichungen der Achse</translation>
    </message>
    <message>
        <source>Surface over position and time</source>
        <translation>Fläche über Position und Zeit</translation>
    </message>
    <message>
        <source>Errors, %1</source>
        <translation>Abweichungen, %1</translation>
    </message>
    <message numerus="yes">
        <source>%n scans, six errors each, relative to the first scan of their artefact.</source>
        <translation>
            <numerusform>%n Scan, sechs Abweichungen, relativ zum ersten Scan seines Prüfkörpers.</numerusform>
            <numerusform>%n Scans, je sechs Abweichungen, relativ zum ersten Scan ihres Prüfkörpers.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::BatchesPanel</name>
    <message>
        <source>Batch</source>
        <translation>Batch-Auftrag</translation>
    </message>
    <message>
        <source>Work</source>
        <translation>Arbeit</translation>
    </message>
    <message>
        <source>Done</source>
        <translation>Erledigt</translation>
    </message>
    <message>
        <source>Failed</source>
        <translation>Fehlgeschlagen</translation>
    </message>
    <message>
        <source>Running</source>
        <translation>Laufend</translation>
    </message>
    <message>
        <source>Cost</source>
        <translation>Kosten</translation>
    </message>
    <message>
        <source>Left</source>
        <translation>Offen</translation>
    </message>
    <message>
        <source>Batches</source>
        <translation>Batch-Aufträge</translation>
    </message>
    <message>
        <source>Choose a plan to start a batch on this computer.</source>
        <translation>Plan wählen, um einen Batch-Auftrag auf diesem Rechner zu starten.</translation>
    </message>
    <message>
        <source>Plan of the batch</source>
        <translation>Plan des Batch-Auftrags</translation>
    </message>
    <message>
        <source>PLAN.json (format spindrift-batch)</source>
        <translation>PLAN.json (Format spindrift-batch)</translation>
    </message>
    <message>
        <source>Plan …</source>
        <translation>Plan …</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Starten</translation>
    </message>
    <message>
        <source>Cancel the batch</source>
        <translation>Batch-Auftrag abbrechen</translation>
    </message>
    <message>
        <source>Stops the batch on every computer; finished items are kept</source>
        <translation>Hält den Batch-Auftrag auf allen Rechnern an; Erledigtes bleibt erhalten</translation>
    </message>
    <message>
        <source>Resume on this computer</source>
        <translation>Auf diesem Rechner fortsetzen</translation>
    </message>
    <message>
        <source>Goes on after a cancellation, and tries again what has failed</source>
        <translation>Setzt nach einem Abbruch fort und wiederholt Fehlgeschlagenes</translation>
    </message>
    <message>
        <source>Choose a plan</source>
        <translation>Plan wählen</translation>
    </message>
    <message>
        <source>Plan (*.json)</source>
        <translation>Plan (*.json)</translation>
    </message>
    <message>
        <source>Looking at batches</source>
        <translation>Batch-Aufträge werden abgefragt</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>%1 min</source>
        <translation>%1 min</translation>
    </message>
    <message>
        <source>%1 h</source>
        <translation>%1 h</translation>
    </message>
    <message>
        <source>nobody</source>
        <translation>niemand</translation>
    </message>
    <message>
        <source>Not running: it waits in Slurm, or its processes have ended; Resume continues it.</source>
        <translation>Läuft nicht: der Batch-Auftrag wartet in Slurm, oder seine Prozesse sind beendet; „Fortsetzen“ führt ihn weiter.</translation>
    </message>
    <message>
        <source>finished</source>
        <translation>beendet</translation>
    </message>
    <message>
        <source>cancelled</source>
        <translation>abgebrochen</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>%1 of %2 (%3 %)</source>
        <translation>%1 von %2 (%3 %)</translation>
    </message>
    <message>
        <source>Batch %1 %2</source>
        <translation>Batch-Auftrag %1 %2</translation>
    </message>
    <message>
        <source>%1 is cancelled; completed items are kept, and Resume continues.</source>
        <translation>%1 ist abgebrochen; Erledigtes bleibt erhalten, „Fortsetzen“ führt ihn weiter.</translation>
    </message>
    <message>
        <source>%1 is finished, %2 failed: spindrift-cli batch status %3 --results FILE says why.</source>
        <translation>%1 ist beendet, %2 fehlgeschlagen: spindrift-cli batch status %3 --results FILE nennt die Gründe.</translation>
    </message>
    <message>
        <source>%1 is finished: %2.</source>
        <translation>%1 ist beendet: %2.</translation>
    </message>
    <message>
        <source>The batch has stopped; completed items are kept, and Resume continues.</source>
        <translation>Der Batch-Auftrag wurde angehalten; Erledigtes bleibt erhalten, „Fortsetzen“ führt ihn weiter.</translation>
    </message>
    <message>
        <source>Batch of %1</source>
        <translation>Batch-Auftrag von %1</translation>
    </message>
    <message>
        <source>Cancelling a batch</source>
        <translation>Batch-Auftrag wird abgebrochen</translation>
    </message>
    <message>
        <source>Processes the campaigns or seeds of the plan on all processors of this computer; starting the same plan again continues it</source>
        <translation>Bearbeitet die Kampagnen oder Startwerte des Plans mit allen Prozessoren dieses Rechners; derselbe Plan, erneut gestartet, wird fortgesetzt</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::CameraPanel</name>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Device number (0), genicam:NAME, video file, or address (rtsp://…)</source>
        <translation>Gerätenummer (0), genicam:NAME, Videodatei oder Adresse (rtsp://…)</translation>
    </message>
    <message>
        <source>Open camera</source>
        <translation>Kamera öffnen</translation>
    </message>
    <message>
        <source>Take picture</source>
        <translation>Bild aufnehmen</translation>
    </message>
    <message>
        <source>Open the camera of the microscope: focus while the sharpness rises, then take the picture. The plan says which one it is.</source>
        <translation>Kamera des Mikroskops öffnen, fokussieren, solange die Schärfe steigt, dann das Bild aufnehmen. Der Plan sagt, welches es ist.</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>Livebild</translation>
    </message>
    <message>
        <source>The picture of the camera will appear here</source>
        <translation>Hier erscheint das Bild der Kamera</translation>
    </message>
    <message>
        <source>What is decoded is drawn on top.</source>
        <translation>Das Decodierte wird darüber gezeichnet.</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source>Sharpness</source>
        <translation>Schärfe</translation>
    </message>
    <message>
        <source>Best so far</source>
        <translation>Bisher beste</translation>
    </message>
    <message>
        <source>Ellipses</source>
        <translation>Ellipsen</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>Sharpness (ratio of contrasts)</source>
        <translation>Schärfe (Verhältnis der Kontraste)</translation>
    </message>
    <message>
        <source>Sharpness over time will appear here</source>
        <translation>Hier erscheint die Schärfe über der Zeit</translation>
    </message>
    <message>
        <source>It is largest in focus.</source>
        <translation>Im Fokus ist sie am größten.</translation>
    </message>
    <message>
        <source>Opening %1 …</source>
        <translation>%1 wird geöffnet …</translation>
    </message>
    <message>
        <source>Close camera</source>
        <translation>Kamera schließen</translation>
    </message>
    <message>
        <source>The camera gives no more pictures; the last one is shown.</source>
        <translation>Die Kamera liefert keine Bilder mehr; gezeigt wird das letzte.</translation>
    </message>
    <message>
        <source>contrast over coarse contrast</source>
        <translation>Kontrast bezogen auf groben Kontrast</translation>
    </message>
    <message>
        <source>%1 % of it now</source>
        <translation>jetzt %1 % davon</translation>
    </message>
    <message>
        <source>blur %1 px</source>
        <translation>Unschärfe %1 px</translation>
    </message>
    <message>
        <source>camera</source>
        <translation>Kamera</translation>
    </message>
    <message numerus="yes">
        <source>The camera has sent no complete frame for %1 s and %n frames with missing packets.</source>
        <translation>
            <numerusform>Die Kamera hat %1 s lang kein vollständiges Bild gesendet und %n Bild mit fehlenden Paketen.</numerusform>
            <numerusform>Die Kamera hat %1 s lang kein vollständiges Bild gesendet und %n Bilder mit fehlenden Paketen.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::CampaignUndo</name>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ClockPanel</name>
    <message>
        <source>change the offset of a clock</source>
        <translation>Uhrversatz ändern</translation>
    </message>
    <message>
        <source>Clocks of logger and instruments differ. The offset is added to the times of a source; a motion that log and instrument both saw gives it.</source>
        <translation>Die Uhren von Protokoll und Messgeräten gehen verschieden. Der Versatz wird zu den Zeiten einer Quelle addiert; eine Bewegung, die beide erfasst haben, liefert ihn.</translation>
    </message>
    <message>
        <source>Source of times</source>
        <translation>Quelle der Zeiten</translation>
    </message>
    <message>
        <source>Offset added to the times of the source</source>
        <translation>Versatz, der zu den Zeiten der Quelle addiert wird</translation>
    </message>
    <message>
        <source> s</source>
        <translation> s</translation>
    </message>
    <message>
        <source>Estimate from the motion</source>
        <translation>Aus der Bewegung schätzen</translation>
    </message>
    <message>
        <source>Source</source>
        <translation>Quelle</translation>
    </message>
    <message>
        <source>Offset</source>
        <translation>Versatz</translation>
    </message>
    <message>
        <source>From</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>Offsets of the clocks</source>
        <translation>Uhrversatz</translation>
    </message>
    <message>
        <source>No clock offset is applied.</source>
        <translation>Es wird kein Uhrenversatz angewandt.</translation>
    </message>
    <message>
        <source>Offset of %1: %2.</source>
        <translation>Versatz von %1: %2.</translation>
    </message>
    <message>
        <source>s</source>
        <translation>s</translation>
    </message>
    <message>
        <source>There are no observations yet to compare the log with. Evaluate the captures first (Calibrate).</source>
        <translation>Es gibt noch keine Beobachtungen, mit denen das Protokoll verglichen werden kann. Zuerst die Aufnahmen auswerten (Kalibrieren).</translation>
    </message>
    <message>
        <source>Estimating the offset of a clock</source>
        <translation>Versatz einer Uhr wird geschätzt</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ClosedLoopPage</name>
    <message>
        <source>Compensate: live</source>
        <translation>Kompensieren: live</translation>
    </message>
    <message>
        <source>Measure, model and compensate at the control, while the machine works.</source>
        <translation>An der Steuerung messen, modellieren und kompensieren, während die Maschine arbeitet.</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Stop and fade to zero</source>
        <translation>Anhalten und auf null abklingen</translation>
    </message>
    <message>
        <source>Start …</source>
        <translation>Starten …</translation>
    </message>
    <message>
        <source>Folder …</source>
        <translation>Ordner …</translation>
    </message>
    <message>
        <source>Where the loop leaves its campaign; one that was ended is continued there</source>
        <translation>Ablageort der Kampagne des Regelkreises; ein beendeter wird dort fortgesetzt</translation>
    </message>
    <message>
        <source>Open plan …</source>
        <translation>Plan öffnen …</translation>
    </message>
    <message>
        <source>What will move</source>
        <translation>Was sich bewegen wird</translation>
    </message>
    <message>
        <source>Not now</source>
        <translation>Nicht jetzt</translation>
    </message>
    <message>
        <source>I am at the machine: start</source>
        <translation>Ich bin an der Maschine: starten</translation>
    </message>
    <message>
        <source>Missing in the simulation: what is added?</source>
        <translation>Fehlt in der Simulation: was wird hinzugefügt?</translation>
    </message>
    <message>
        <source>Effect</source>
        <translation>Effekt</translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation>Konfidenz</translation>
    </message>
    <message>
        <source>Indistinguishable from</source>
        <translation>Nicht unterscheidbar von</translation>
    </message>
    <message>
        <source>Named effects</source>
        <translation>Benannte Effekte</translation>
    </message>
    <message>
        <source>Add the selected effects</source>
        <translation>Markierte Effekte hinzufügen</translation>
    </message>
    <message>
        <source>%1, applied now</source>
        <translation>%1, jetzt aufgeschaltet</translation>
    </message>
    <message>
        <source>Age of the inputs</source>
        <translation>Alter der Eingangsgrößen</translation>
    </message>
    <message>
        <source>Measurements spent</source>
        <translation>Verbrauchte Messungen</translation>
    </message>
    <message>
        <source>If Spindrift stops responding:</source>
        <translation>Wenn Spindrift nicht mehr antwortet:</translation>
    </message>
    <message>
        <source>Fade to zero</source>
        <translation>Auf null abklingen</translation>
    </message>
    <message>
        <source>Hold</source>
        <translation>Halten</translation>
    </message>
    <message>
        <source>Compensation if Spindrift stops responding</source>
        <translation>Kompensation, wenn Spindrift nicht mehr antwortet</translation>
    </message>
    <message>
        <source>Error at the tool point, without and with</source>
        <translation>Abweichung am Werkzeugpunkt, ohne und mit</translation>
    </message>
    <message>
        <source>Axis of the plot</source>
        <translation>Achse des Diagramms</translation>
    </message>
    <message>
        <source>The measuring cycles will appear here</source>
        <translation>Hier erscheinen die Messzyklen</translation>
    </message>
    <message>
        <source>Open a plan, press Start, and confirm what will move.</source>
        <translation>Plan öffnen, „Starten“ drücken und bestätigen, was sich bewegen wird.</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Event</source>
        <translation>Ereignis</translation>
    </message>
    <message>
        <source>Events of the loop appear here.</source>
        <translation>Hier erscheinen die Ereignisse des Regelkreises.</translation>
    </message>
    <message>
        <source>Open a plan of a loop</source>
        <translation>Plan eines Regelkreises öffnen</translation>
    </message>
    <message>
        <source>Plan (*.json)</source>
        <translation>Plan (*.json)</translation>
    </message>
    <message>
        <source>Folder for the campaign of the loop</source>
        <translation>Ordner für die Kampagne des Regelkreises</translation>
    </message>
    <message>
        <source>Add nothing</source>
        <translation>Nichts hinzufügen</translation>
    </message>
    <message>
        <source>A plan (JSON, spindrift-loop-plan) says which control, what is touched, which program runs and when.</source>
        <translation>Ein Plan (JSON, spindrift-loop-plan) legt Steuerung, Messobjekte, Programm und Zeitpunkte fest.</translation>
    </message>
    <message>
        <source>%1 at %2:%3 · plan %4 · campaign in %5</source>
        <translation>%1 an %2:%3 · Plan %4 · Kampagne in %5</translation>
    </message>
    <message>
        <source>Go on …</source>
        <translation>Fortsetzen …</translation>
    </message>
    <message>
        <source>The machine will be switched on and homed. A measuring cycle moves: %1. Between cycles the spindle turns by the program, %2 h in all. The compensation stays within ±%3 µm and changes by at most %4 µm/s. Keep clear of the machine.</source>
        <translation>Die Maschine wird eingeschaltet und referenziert. Ein Messzyklus bewegt: %1. Zwischen den Zyklen dreht die Spindel nach Programm, insgesamt %2 h. Die Kompensation bleibt innerhalb ±%3 µm und ändert sich um höchstens %4 µm/s. Abstand zur Maschine halten.</translation>
    </message>
    <message>
        <source>The measuring cycle may not run: line %1: %2.</source>
        <translation>Der Messzyklus darf nicht laufen: Zeile %1: %2.</translation>
    </message>
    <message>
        <source>The last compensation value is held, whatever the machine does afterwards.</source>
        <translation>Der letzte Kompensationswert wird gehalten, was auch immer die Maschine danach tut.</translation>
    </message>
    <message>
        <source>No compensation is applied without supervision.</source>
        <translation>Ohne Überwachung wird nichts kompensiert.</translation>
    </message>
    <message>
        <source>The loop has ended: %1</source>
        <translation>Der Regelkreis ist beendet: %1</translation>
    </message>
    <message>
        <source>Connecting with the control, looking at its limits and its watchdog …</source>
        <translation>Verbindung zur Steuerung wird aufgebaut, Grenzen und Überwachung (Watchdog) werden geprüft …</translation>
    </message>
    <message>
        <source>Stopping: the compensation fades to zero. %1</source>
        <translation>Wird angehalten: die Kompensation klingt auf null ab. %1</translation>
    </message>
    <message>
        <source> A measuring cycle is running.</source>
        <translation> Ein Messzyklus läuft.</translation>
    </message>
    <message>
        <source>Active, by the %1. Control: %2</source>
        <translation>Aktiv, nach %1. Steuerung: %2</translation>
    </message>
    <message>
        <source>Not active. %1</source>
        <translation>Nicht aktiv. %1</translation>
    </message>
    <message>
        <source>Not active: %1. Control: %2</source>
        <translation>Nicht aktiv: %1. Steuerung: %2</translation>
    </message>
    <message>
        <source>The plan has come to its end; the compensation is at zero. The report lies in the folder of the campaign.</source>
        <translation>Der Plan ist zu Ende; die Kompensation ist null. Der Bericht liegt im Ordner der Kampagne.</translation>
    </message>
    <message>
        <source>Stopped; the compensation is at zero. The loop can go on from its folder.</source>
        <translation>Angehalten; die Kompensation ist null. Der Regelkreis kann aus seinem Ordner fortgesetzt werden.</translation>
    </message>
    <message>
        <source>Open the plan of a loop to begin.</source>
        <translation>Zum Beginn den Plan eines Regelkreises öffnen.</translation>
    </message>
    <message>
        <source>A loop of this plan was ended before its time: Go on takes it up where it stood.</source>
        <translation>Ein Regelkreis dieses Plans wurde vorzeitig beendet: „Fortsetzen“ nimmt ihn an der Stelle wieder auf.</translation>
    </message>
    <message>
        <source>Press Start to see what will move; nothing moves before you have confirmed it.</source>
        <translation>„Starten“ zeigt, was sich bewegen wird; vor der Bestätigung bewegt sich nichts.</translation>
    </message>
    <message>
        <source>not active</source>
        <translation>nicht aktiv</translation>
    </message>
    <message>
        <source>± standard uncertainty</source>
        <translation>± Standardunsicherheit</translation>
    </message>
    <message>
        <source>how sure: not known yet</source>
        <translation>Unsicherheit: noch nicht bekannt</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>machine time %1 h</source>
        <translation>Maschinenzeit %1 h</translation>
    </message>
    <message numerus="yes">
        <source>%n cycles</source>
        <translation>
            <numerusform>%n Zyklus</numerusform>
            <numerusform>%n Zyklen</numerusform>
        </translation>
    </message>
    <message>
        <source>the next in %1 min</source>
        <translation>der nächste in %1 min</translation>
    </message>
    <message>
        <source>or</source>
        <translation>oder</translation>
    </message>
    <message>
        <source>%1 h</source>
        <translation>%1 h</translation>
    </message>
    <message>
        <source>without</source>
        <translation>ohne</translation>
    </message>
    <message>
        <source>with compensation</source>
        <translation>mit Kompensation</translation>
    </message>
    <message>
        <source>Machine time / h</source>
        <translation>Maschinenzeit / h</translation>
    </message>
    <message>
        <source>Error without and with: no cycle has been compensated yet.</source>
        <translation>Abweichung ohne und mit: es wurde noch kein Zyklus kompensiert.</translation>
    </message>
    <message>
        <source>%1: %2 µm rms without, %3 µm rms with, over %4 since the compensation began.</source>
        <translation>%1: %2 µm rms ohne, %3 µm rms mit Kompensation, über %4 seit ihrem Beginn.</translation>
    </message>
    <message>
        <source>Events</source>
        <translation>Ereignisse</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ClosedLoopService</name>
    <message>
        <source>The loop runs: stop it before another plan is opened.</source>
        <translation>Der Regelkreis läuft: vor dem Öffnen eines anderen Plans anhalten.</translation>
    </message>
    <message>
        <source>Open a plan first.</source>
        <translation>Zuerst einen Plan öffnen.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::CloudPainter</name>
    <message>
        <source>Paint on the scan</source>
        <translation>Auf dem Scan markieren</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ColumnsCard</name>
    <message>
        <source>&lt; 1 s</source>
        <translation>&lt; 1 s</translation>
    </message>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>%1 min</source>
        <translation>%1 min</translation>
    </message>
    <message>
        <source>%1 h</source>
        <translation>%1 h</translation>
    </message>
    <message>
        <source>Columns of the log</source>
        <translation>Spalten des Protokolls</translation>
    </message>
    <message>
        <source>More of the column: scale, words, dead band …</source>
        <translation>Mehr zur Spalte: Skalierung, Wörter, Totband …</translation>
    </message>
    <message>
        <source>More of the column</source>
        <translation>Mehr zur Spalte</translation>
    </message>
    <message>
        <source>Take the column away</source>
        <translation>Spalte wegnehmen</translation>
    </message>
    <message>
        <source>Remove the column</source>
        <translation>Spalte entfernen</translation>
    </message>
    <message>
        <source>Column</source>
        <translation>Spalte</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Jetzt</translation>
    </message>
    <message>
        <source>Age</source>
        <translation>Alter</translation>
    </message>
    <message>
        <source>Quality</source>
        <translation>Güte</translation>
    </message>
    <message>
        <source>From</source>
        <translation>Von</translation>
    </message>
    <message>
        <source>Unit there</source>
        <translation>Einheit dort</translation>
    </message>
    <message>
        <source>Role</source>
        <translation>Rolle</translation>
    </message>
    <message>
        <source>change a column</source>
        <translation>Spalte ändern</translation>
    </message>
    <message>
        <source>state the role of a sensor</source>
        <translation>Rolle eines Sensors angeben</translation>
    </message>
    <message>
        <source>Stated here</source>
        <translation>Hier angegeben</translation>
    </message>
    <message>
        <source>As the source says; type another to state it</source>
        <translation>Wie von der Quelle angegeben; eine andere eintippen, um sie festzulegen</translation>
    </message>
    <message>
        <source>Role of %1</source>
        <translation>Rolle von %1</translation>
    </message>
    <message>
        <source>not stated</source>
        <translation>nicht angegeben</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>verloren</translation>
    </message>
    <message>
        <source>waiting</source>
        <translation>wartend</translation>
    </message>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>Data items that are ticked become columns.</source>
        <translation>Angekreuzte Datenpunkte werden Spalten.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::CommandPalette</name>
    <message>
        <source>Find a command</source>
        <translation>Befehl suchen</translation>
    </message>
    <message>
        <source>A few letters of what you want to do</source>
        <translation>Einige Buchstaben des gewünschten Befehls</translation>
    </message>
    <message>
        <source>The arrows choose in the list, Enter runs, Escape closes</source>
        <translation>Die Pfeiltasten wählen in der Liste, Enter führt aus, Escape schließt</translation>
    </message>
    <message>
        <source>Command</source>
        <translation>Befehl</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>Keys</source>
        <translation>Tastenkürzel</translation>
    </message>
    <message>
        <source>Commands</source>
        <translation>Befehle</translation>
    </message>
    <message>
        <source>Nothing the window can do fits these letters.</source>
        <translation>Kein Befehl des Fensters passt zu diesen Buchstaben.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::CompensatePage</name>
    <message>
        <source>Live …</source>
        <translation>Live …</translation>
    </message>
    <message>
        <source>Measure, model and compensate at the control, while the machine works</source>
        <translation>An der Steuerung messen, modellieren und kompensieren, während die Maschine arbeitet</translation>
    </message>
    <message>
        <source>Export files …</source>
        <translation>Dateien exportieren …</translation>
    </message>
    <message>
        <source>Calculate the compensation</source>
        <translation>Kompensation berechnen</translation>
    </message>
    <message>
        <source>Model to compensate with</source>
        <translation>Modell für die Kompensation</translation>
    </message>
    <message>
        <source>Thermal state to compensate</source>
        <translation>Zu kompensierender thermischer Zustand</translation>
    </message>
    <message>
        <source>Positions along each axis in the files</source>
        <translation>Positionen entlang jeder Achse in den Dateien</translation>
    </message>
    <message>
        <source>Positions along each axis in the grid and the tables</source>
        <translation>Positionen entlang jeder Achse im Gitter und in den Tabellen</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Positions</source>
        <translation>Positionen</translation>
    </message>
    <message>
        <source>At / mm</source>
        <translation>Bei / mm</translation>
    </message>
    <message>
        <source>Reference position %1 of the tables in mm</source>
        <translation>Referenzposition %1 der Tabellen in mm</translation>
    </message>
    <message>
        <source>Measured before, rms</source>
        <translation>Vorher gemessen, rms</translation>
    </message>
    <message>
        <source>Expected with the correction, rms</source>
        <translation>Mit Korrektur erwartet, rms</translation>
    </message>
    <message>
        <source>Uncertainty of the correction</source>
        <translation>Unsicherheit der Korrektur</translation>
    </message>
    <message>
        <source>Largest correction</source>
        <translation>Größte Korrektur</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>X / µm</source>
        <translation>X / µm</translation>
    </message>
    <message>
        <source>Y / µm</source>
        <translation>Y / µm</translation>
    </message>
    <message>
        <source>Z / µm</source>
        <translation>Z / µm</translation>
    </message>
    <message>
        <source>Remains</source>
        <translation>Verbleibt</translation>
    </message>
    <message>
        <source>Correction at each point</source>
        <translation>Korrektur an jedem Punkt</translation>
    </message>
    <message>
        <source>Corrections appear here.</source>
        <translation>Hier erscheinen die Korrekturen.</translation>
    </message>
    <message>
        <source>Correction at the points</source>
        <translation>Korrektur an den Punkten</translation>
    </message>
    <message>
        <source>File</source>
        <translation>Datei</translation>
    </message>
    <message>
        <source>What it holds</source>
        <translation>Inhalt</translation>
    </message>
    <message>
        <source>Files for the control</source>
        <translation>Dateien für die Steuerung</translation>
    </message>
    <message>
        <source>Files appear here.</source>
        <translation>Hier erscheinen die Dateien.</translation>
    </message>
    <message>
        <source>Beginning of the file</source>
        <translation>Anfang der Datei</translation>
    </message>
    <message>
        <source>Files and their signs</source>
        <translation>Dateien und ihre Vorzeichen</translation>
    </message>
    <message>
        <source>Correction</source>
        <translation>Korrektur</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>What the arrows show</source>
        <translation>Was die Pfeile zeigen</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Arrows at the points will appear here</source>
        <translation>Hier erscheinen die Pfeile an den Punkten</translation>
    </message>
    <message>
        <source>Calculate the compensation.</source>
        <translation>Kompensation berechnen.</translation>
    </message>
    <message>
        <source>Folder for the files</source>
        <translation>Ordner für die Dateien</translation>
    </message>
    <message>
        <source>choose the model to compensate with</source>
        <translation>Modell für die Kompensation wählen</translation>
    </message>
    <message>
        <source>choose the state to compensate</source>
        <translation>zu kompensierenden Zustand wählen</translation>
    </message>
    <message>
        <source>change the positions of the files</source>
        <translation>Positionen der Dateien ändern</translation>
    </message>
    <message>
        <source>change the reference position of the tables</source>
        <translation>Referenzposition der Tabellen ändern</translation>
    </message>
    <message>
        <source>Completed simulation</source>
        <translation>Ergänzte Simulation</translation>
    </message>
    <message>
        <source>Nine parameters</source>
        <translation>Neun Parameter</translation>
    </message>
    <message>
        <source>Higher order</source>
        <translation>Höhere Ordnung</translation>
    </message>
    <message>
        <source>There is no model to compensate with yet</source>
        <translation>Es gibt noch kein Modell für die Kompensation</translation>
    </message>
    <message>
        <source>Fit the nine parameters (Model), or add a missing effect to the simulation (Discrepancy). Then this page says what would be commanded at each point and writes the files for the control.</source>
        <translation>Die neun Parameter anpassen (Modell) oder einen fehlenden Effekt zur Simulation hinzufügen (Diskrepanz). Dann zeigt diese Seite die Korrektur an jedem Punkt und schreibt die Dateien für die Steuerung.</translation>
    </message>
    <message>
        <source>Choose model and state, then press Calculate the compensation.</source>
        <translation>Modell und Zustand wählen, dann „Kompensation berechnen“ drücken.</translation>
    </message>
    <message>
        <source>Changed since the compensation was calculated: %1.</source>
        <translation>Geändert, seit die Kompensation berechnet wurde: %1.</translation>
    </message>
    <message>
        <source>Calculate again</source>
        <translation>Erneut berechnen</translation>
    </message>
    <message>
        <source>Use the higher order</source>
        <translation>Höhere Ordnung verwenden</translation>
    </message>
    <message>
        <source>Files written to %1: %2</source>
        <translation>Dateien nach %1 geschrieben: %2</translation>
    </message>
    <message>
        <source>Corrections at the points</source>
        <translation>Korrekturen an den Punkten</translation>
    </message>
    <message>
        <source>Corrections on the machine</source>
        <translation>Korrekturen an der Maschine</translation>
    </message>
    <message>
        <source>state %1</source>
        <translation>Zustand %1</translation>
    </message>
    <message>
        <source>%1 (before %2) %3</source>
        <translation>%1 (vorher %2) %3</translation>
    </message>
    <message>
        <source>On data not used for fitting: %1.</source>
        <translation>An nicht zur Anpassung verwendeten Werten: %1.</translation>
    </message>
    <message>
        <source>%1 where nothing was fitted</source>
        <translation>%1, wo nichts angepasst wurde</translation>
    </message>
    <message>
        <source>fitted values; noise included</source>
        <translation>angepasste Werte; einschließlich Rauschen</translation>
    </message>
    <message>
        <source>one standard uncertainty, rms</source>
        <translation>eine Standardunsicherheit, rms</translation>
    </message>
    <message>
        <source>length of the vector at a point</source>
        <translation>Länge des Vektors an einem Punkt</translation>
    </message>
    <message>
        <source>Simulation completed by %1.</source>
        <translation>Simulation ergänzt um %1.</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>Relative to %1.</source>
        <translation>Bezogen auf %1.</translation>
    </message>
    <message>
        <source>Not used by the fit: it only validates</source>
        <translation>Nicht in der Anpassung verwendet: nur zur Validierung</translation>
    </message>
    <message>
        <source>
… %1 lines in all</source>
        <translation>
… insgesamt %1 Zeilen</translation>
    </message>
    <message>
        <source>Correction to add to the command, state %1</source>
        <translation>Korrektur, die zum Sollwert zu addieren ist, Zustand %1</translation>
    </message>
    <message>
        <source>Measured deviation of state %1</source>
        <translation>Gemessene Abweichung des Zustands %1</translation>
    </message>
    <message>
        <source>What remains of state %1 with the correction</source>
        <translation>Was vom Zustand %1 mit der Korrektur verbleibt</translation>
    </message>
    <message>
        <source>Reading the compensation</source>
        <translation>Die Kompensation wird gelesen</translation>
    </message>
    <message>
        <source>Measured %1; remains: %2</source>
        <translation>Gemessen %1; übrig: %2</translation>
    </message>
    <message>
        <source>not tried</source>
        <translation>nicht versucht</translation>
    </message>
    <message>
        <source>+ moves to +</source>
        <translation>+ geht nach +</translation>
    </message>
    <message>
        <source>+ moves to −</source>
        <translation>+ geht nach −</translation>
    </message>
    <message>
        <source>Direction in which a positive value of Fanuc pitch error data moves the axis</source>
        <translation>Richtung, in die ein positiver Wert der Fanuc-Steigungsfehlerdaten die Achse bewegt</translation>
    </message>
    <message>
        <source>Public documents do not say which way a positive value of Fanuc pitch error data moves the axis. Set one value of 10 detection units on the control, move over its section in the positive direction with an indicator on the axis, and see whether it goes further than before (+ moves to +) or less far (+ moves to −).</source>
        <translation>Öffentliche Unterlagen sagen nicht, wohin ein positiver Wert der Fanuc-Steigungsfehlerdaten die Achse bewegt. An der Steuerung einen Wert auf 10 Erfassungseinheiten setzen, mit einer Messuhr an der Achse in positiver Richtung über seinen Abschnitt fahren und sehen, ob sie weiter geht als zuvor (+ geht nach +) oder weniger weit (+ geht nach −).</translation>
    </message>
    <message>
        <source>Fanuc</source>
        <translation>Fanuc</translation>
    </message>
    <message>
        <source>state the direction of Fanuc pitch error data</source>
        <translation>Richtung der Fanuc-Steigungsfehlerdaten angeben</translation>
    </message>
    <message>
        <source>Remains / µm</source>
        <translation>Verbleibt / µm</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ConnectionsPanel</name>
    <message>
        <source>Address of a source</source>
        <translation>Adresse einer Quelle</translation>
    </message>
    <message>
        <source>http://… (MTConnect), mqtt://…, modbus://…, serial:///dev/…, tcp://…, linuxcnc://… or genicam:…</source>
        <translation>http://… (MTConnect), mqtt://…, modbus://…, serial:///dev/…, tcp://…, linuxcnc://… oder genicam:…</translation>
    </message>
    <message>
        <source>See what is there</source>
        <translation>Angebot anzeigen</translation>
    </message>
    <message>
        <source>Live view</source>
        <translation>Live-Ansicht</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Aufzeichnen</translation>
    </message>
    <message>
        <source>Writes what comes into log.csv of this campaign, on its clock</source>
        <translation>Schreibt das Eingehende in log.csv dieser Kampagne, nach deren Uhr</translation>
    </message>
    <message>
        <source>Recording is on: stop it first. The columns of a log cannot change while it is written.</source>
        <translation>Die Aufzeichnung läuft: zuerst anhalten. Die Spalten eines Protokolls können sich nicht ändern, während es geschrieben wird.</translation>
    </message>
    <message>
        <source>source</source>
        <translation>Quelle</translation>
    </message>
    <message>
        <source>add the source %1</source>
        <translation>Quelle %1 hinzufügen</translation>
    </message>
    <message>
        <source>Listing %1</source>
        <translation>%1 wird aufgelistet</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>Verbindung wird aufgebaut</translation>
    </message>
    <message>
        <source>listening</source>
        <translation>empfangsbereit</translation>
    </message>
    <message>
        <source>leave %1 out</source>
        <translation>%1 auslassen</translation>
    </message>
    <message>
        <source>record %1</source>
        <translation>%1 aufzeichnen</translation>
    </message>
    <message>
        <source>Options of %1</source>
        <translation>Optionen von %1</translation>
    </message>
    <message>
        <source>A password never stands in the session: say in which variable of the environment or in which file it is.</source>
        <translation>Ein Passwort steht nie in der Sitzung: angeben, in welcher Umgebungsvariablen oder Datei es steht.</translation>
    </message>
    <message>
        <source>change the source %1</source>
        <translation>Quelle %1 ändern</translation>
    </message>
    <message>
        <source>Column %1</source>
        <translation>Spalte %1</translation>
    </message>
    <message>
        <source>Value = scale · (value in the unit of the column) + offset. A row is written where it changes by more than the dead band.</source>
        <translation>Wert = Faktor · (Wert in der Einheit der Spalte) + Versatz. Eine Zeile wird geschrieben, wenn sich der Wert um mehr als das Totband ändert.</translation>
    </message>
    <message>
        <source>Column</source>
        <translation>Spalte</translation>
    </message>
    <message>
        <source>Data item</source>
        <translation>Datenpunkt</translation>
    </message>
    <message>
        <source>Unit there</source>
        <translation>Einheit dort</translation>
    </message>
    <message>
        <source>as the source says</source>
        <translation>wie von der Quelle angegeben</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>Faktor</translation>
    </message>
    <message>
        <source>Offset</source>
        <translation>Versatz</translation>
    </message>
    <message>
        <source>Dead band</source>
        <translation>Totband</translation>
    </message>
    <message>
        <source>Of an interval</source>
        <translation>Aus einem Intervall</translation>
    </message>
    <message>
        <source>last, mean, mean_absolute, max or min</source>
        <translation>last, mean, mean_absolute, max oder min</translation>
    </message>
    <message>
        <source>Words and their numbers</source>
        <translation>Wörter und ihre Zahlen</translation>
    </message>
    <message>
        <source>ACTIVE=1, READY=0</source>
        <translation>ACTIVE=1, READY=0</translation>
    </message>
    <message>
        <source>Any other word</source>
        <translation>Jedes andere Wort</translation>
    </message>
    <message>
        <source>unknown</source>
        <translation>unbekannt</translation>
    </message>
    <message>
        <source>change a column</source>
        <translation>Spalte ändern</translation>
    </message>
    <message>
        <source>remove the source %1</source>
        <translation>Quelle %1 entfernen</translation>
    </message>
    <message>
        <source>remove a column</source>
        <translation>Spalte entfernen</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>Verbindungen</translation>
    </message>
    <message>
        <source>Connections (*.json)</source>
        <translation>Verbindungen (*.json)</translation>
    </message>
    <message>
        <source>take over %1</source>
        <translation>%1 übernehmen</translation>
    </message>
    <message>
        <source>Stop live view</source>
        <translation>Live-Ansicht beenden</translation>
    </message>
    <message>
        <source>Stop recording</source>
        <translation>Aufzeichnung beenden</translation>
    </message>
    <message>
        <source>It is tried again and again.</source>
        <translation>Der Versuch wird ständig wiederholt.</translation>
    </message>
    <message>
        <source> The last gap: %1.</source>
        <translation> Die letzte Lücke: %1.</translation>
    </message>
    <message>
        <source>Live: %1 of %2 columns have values; nothing is written.</source>
        <translation>Live: %1 von %2 Spalten haben Werte; es wird nichts geschrieben.</translation>
    </message>
    <message>
        <source>Enter the address of a machine, a broker, a module or a logger, and see what is there. It is only read; nothing is written to it.</source>
        <translation>Adresse einer Maschine, eines Brokers, eines Moduls oder eines Datenloggers eingeben und das Angebot anzeigen. Es wird nur gelesen, nie geschrieben.</translation>
    </message>
    <message>
        <source>Tick the data items that are to be recorded; each becomes a column of the log.</source>
        <translation>Aufzuzeichnende Datenpunkte ankreuzen; jeder wird eine Spalte des Protokolls.</translation>
    </message>
    <message>
        <source>The log is being closed.</source>
        <translation>Das Protokoll wird geschlossen.</translation>
    </message>
    <message>
        <source>Live values</source>
        <translation>Livewerte</translation>
    </message>
    <message>
        <source>1</source>
        <translation>1</translation>
    </message>
    <message>
        <source>9600</source>
        <translation>9600</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>Append every line to</source>
        <translation>Jede Zeile anhängen an</translation>
    </message>
    <message>
        <source>Baud</source>
        <translation>Baudrate</translation>
    </message>
    <message>
        <source>Certificates</source>
        <translation>Zertifikate</translation>
    </message>
    <message>
        <source>Exposure / µs</source>
        <translation>Belichtung / µs</translation>
    </message>
    <message>
        <source>File with the password</source>
        <translation>Datei mit dem Passwort</translation>
    </message>
    <message>
        <source>Gain</source>
        <translation>Verstärkung</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Name of this client</source>
        <translation>Name dieses Clients</translation>
    </message>
    <message>
        <source>Parity</source>
        <translation>Parität</translation>
    </message>
    <message>
        <source>Pattern of a line</source>
        <translation>Muster einer Zeile</translation>
    </message>
    <message>
        <source>Read every / s</source>
        <translation>Abfrage alle / s</translation>
    </message>
    <message>
        <source>Region</source>
        <translation>Bereich</translation>
    </message>
    <message>
        <source>Stream every / s</source>
        <translation>Senden alle / s</translation>
    </message>
    <message>
        <source>T1={column} T2={bed}</source>
        <translation>T1={column} T2={bed}</translation>
    </message>
    <message>
        <source>Trigger</source>
        <translation>Auslöser</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>User</source>
        <translation>Benutzer</translation>
    </message>
    <message>
        <source>Variable with the password</source>
        <translation>Variable mit dem Passwort</translation>
    </message>
    <message>
        <source>as the camera has it</source>
        <translation>wie in der Kamera eingestellt</translation>
    </message>
    <message>
        <source>file with those that are trusted</source>
        <translation>Datei mit den vertrauenswürdigen Zertifikaten</translation>
    </message>
    <message>
        <source>file, for printed touches</source>
        <translation>Datei, für gedruckte Antastungen</translation>
    </message>
    <message>
        <source>in the unit of the camera, mostly dB</source>
        <translation>in der Einheit der Kamera, meist dB</translation>
    </message>
    <message>
        <source>name of a variable of the environment</source>
        <translation>Name einer Umgebungsvariablen</translation>
    </message>
    <message>
        <source>none, even or odd</source>
        <translation>none, even oder odd</translation>
    </message>
    <message>
        <source>none; Software, Line1 …</source>
        <translation>none; Software, Line1 …</translation>
    </message>
    <message>
        <source>of linuxcncrsh; name of a variable of the environment</source>
        <translation>von linuxcncrsh; Name einer Umgebungsvariablen</translation>
    </message>
    <message>
        <source>readable by its owner only</source>
        <translation>nur für den Eigentümer lesbar</translation>
    </message>
    <message>
        <source>with one, nothing is missed while it is away</source>
        <translation>mit Namen geht nichts verloren, solange er getrennt ist</translation>
    </message>
    <message>
        <source>x, y, width, height in pixels</source>
        <translation>x, y, Breite, Höhe in Pixeln</translation>
    </message>
    <message numerus="yes">
        <source>Recording into log.csv of this campaign: %n rows, %1 of %2 columns have values. You may leave this page; recording continues.%3</source>
        <translation>
            <numerusform>Aufzeichnung in log.csv dieser Kampagne: %n Zeile, %1 von %2 Spalten haben Werte. Sie können diese Seite verlassen; die Aufzeichnung läuft weiter.%3</numerusform>
            <numerusform>Aufzeichnung in log.csv dieser Kampagne: %n Zeilen, %1 von %2 Spalten haben Werte. Sie können diese Seite verlassen; die Aufzeichnung läuft weiter.%3</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n columns are mapped. Look at them live, or record them into the log of this campaign.</source>
        <translation>
            <numerusform>%n Spalte ist zugeordnet. Live ansehen oder in das Protokoll dieser Kampagne aufzeichnen.</numerusform>
            <numerusform>%n Spalten sind zugeordnet. Live ansehen oder in das Protokoll dieser Kampagne aufzeichnen.</numerusform>
        </translation>
    </message>
    <message>
        <source>http://…, mqtt://… or other</source>
        <translation>http://…, mqtt://… o. a.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ConnectionsService</name>
    <message>
        <source>spindle</source>
        <translation>Spindel</translation>
    </message>
    <message>
        <source>Open a session or a new measurement first.</source>
        <translation>Zuerst eine Sitzung oder eine neue Messung öffnen.</translation>
    </message>
    <message>
        <source>No data item is mapped to a column yet: tick what is to be recorded.</source>
        <translation>Noch ist kein Datenpunkt einer Spalte zugeordnet: ankreuzen, was aufgezeichnet werden soll.</translation>
    </message>
    <message>
        <source>The log of the last recording is still being closed; try again soon.</source>
        <translation>Das Protokoll der letzten Aufzeichnung wird noch geschlossen; in Kürze erneut versuchen.</translation>
    </message>
    <message>
        <source>%1 cannot be reached: %2</source>
        <translation>%1 ist nicht erreichbar: %2</translation>
    </message>
    <message>
        <source>%1 is lost: %2</source>
        <translation>%1 ist ausgefallen: %2</translation>
    </message>
    <message>
        <source>%1 is there again.</source>
        <translation>%1 ist wieder da.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::CycleModelPage</name>
    <message>
        <source>Separate the errors of axes, table and artefact in every cycle, and see how well each is known.</source>
        <translation>Abweichungen von Achsen, Tisch und Prüfkörper in jedem Zyklus trennen und sehen, wie gut jede bekannt ist.</translation>
    </message>
    <message>
        <source>Fit all cycles</source>
        <translation>Alle Zyklen anpassen</translation>
    </message>
    <message>
        <source>Errors over time</source>
        <translation>Abweichungen über der Zeit</translation>
    </message>
    <message>
        <source>Displacements</source>
        <translation>Verschiebungen</translation>
    </message>
    <message>
        <source>Rotations</source>
        <translation>Drehungen</translation>
    </message>
    <message>
        <source>Growth</source>
        <translation>Ausdehnung</translation>
    </message>
    <message>
        <source>Group of parameters</source>
        <translation>Gruppe von Parametern</translation>
    </message>
    <message>
        <source>Time / h</source>
        <translation>Zeit / h</translation>
    </message>
    <message>
        <source>Displacement / µm</source>
        <translation>Verschiebung / µm</translation>
    </message>
    <message>
        <source>Trends will appear here</source>
        <translation>Hier erscheinen die Verläufe</translation>
    </message>
    <message>
        <source>Fit all cycles: every error parameter is drawn over time with its uncertainty.</source>
        <translation>Alle Zyklen anpassen: jeder Parameter wird mit seiner Unsicherheit über der Zeit dargestellt.</translation>
    </message>
    <message>
        <source>Cycle</source>
        <translation>Zyklus</translation>
    </message>
    <message>
        <source>Cycle shown in detail</source>
        <translation>Im Einzelnen gezeigter Zyklus</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Meaning</source>
        <translation>Bedeutung</translation>
    </message>
    <message>
        <source>Parameters of the cycle</source>
        <translation>Parameter des Zyklus</translation>
    </message>
    <message>
        <source>Every parameter with its uncertainty appears after the fit.</source>
        <translation>Nach der Anpassung erscheint hier jeder Parameter mit seiner Unsicherheit.</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Condition number</source>
        <translation>Konditionszahl</translation>
    </message>
    <message>
        <source>Determined worst</source>
        <translation>Am schlechtesten bestimmt</translation>
    </message>
    <message>
        <source>Not determined</source>
        <translation>Nicht bestimmt</translation>
    </message>
    <message>
        <source>Weak combinations</source>
        <translation>Schwach bestimmte Kombinationen</translation>
    </message>
    <message>
        <source>Most strongly correlated parameters are listed after the fit.</source>
        <translation>Am stärksten korrelierte Parameter stehen hier nach der Anpassung.</translation>
    </message>
    <message>
        <source>Reading the cycles</source>
        <translation>Zyklen werden gelesen</translation>
    </message>
    <message>
        <source>The touches are not evaluated yet.</source>
        <translation>Die Antastungen sind noch nicht ausgewertet.</translation>
    </message>
    <message>
        <source>Go to Calibrate</source>
        <translation>Zu „Kalibrieren“ wechseln</translation>
    </message>
    <message>
        <source>Changed since: %1. Fit all cycles again.</source>
        <translation>Geändert seitdem: %1. Alle Zyklen erneut anpassen.</translation>
    </message>
    <message>
        <source>Press Fit all cycles. One least squares over all touches separates the errors; everything is relative to the first cycle.</source>
        <translation>„Alle Zyklen anpassen“ drücken. Ein gemeinsamer Ausgleich über alle Antastungen trennt die Abweichungen; alles ist auf den ersten Zyklus bezogen.</translation>
    </message>
    <message numerus="yes">
        <source>%1 parameters are determined in each of %n cycles.</source>
        <translation>
            <numerusform>%1 Parameter sind im einzigen Zyklus bestimmt.</numerusform>
            <numerusform>%1 Parameter sind in jedem von %n Zyklen bestimmt.</numerusform>
        </translation>
    </message>
    <message>
        <source>This page shows %1. The other artefacts are evaluated too: their deviations stand in the observations and in the report.</source>
        <translation>Diese Seite zeigt %1. Die anderen Prüfkörper werden ebenfalls ausgewertet: ihre Abweichungen stehen in den Beobachtungen und im Bericht.</translation>
    </message>
    <message>
        <source>Rotation / µrad</source>
        <translation>Drehung / µrad</translation>
    </message>
    <message>
        <source>Growth / µm/m</source>
        <translation>Ausdehnung / µm/m</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>not determined</source>
        <translation>nicht bestimmt</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>The reference: all others are relative to it.</source>
        <translation>Die Referenz: alle anderen sind auf sie bezogen.</translation>
    </message>
    <message>
        <source>%1 and %2</source>
        <translation>%1 und %2</translation>
    </message>
    <message>
        <source>Condition number %1; most strongly correlated: %2</source>
        <translation>Konditionszahl %1; am stärksten korreliert: %2</translation>
    </message>
    <message>
        <source>Deviation from a straight line</source>
        <translation>Abweichung von einer Geraden</translation>
    </message>
    <message>
        <source>Volumetric error</source>
        <translation>Volumetrische Abweichung</translation>
    </message>
    <message>
        <source>Volumetric error values</source>
        <translation>Werte der volumetrischen Abweichung</translation>
    </message>
    <message>
        <source>Component</source>
        <translation>Komponente</translation>
    </message>
    <message>
        <source>The heat map will appear here</source>
        <translation>Hier erscheint die Farbkarte</translation>
    </message>
    <message>
        <source>Fit all cycles: the error is drawn on a plane through the working space.</source>
        <translation>Alle Zyklen anpassen: die Abweichung wird auf einer Ebene durch den Arbeitsraum dargestellt.</translation>
    </message>
    <message>
        <source>Plane at</source>
        <translation>Ebene bei</translation>
    </message>
    <message>
        <source>Axis the plane is normal to</source>
        <translation>Achse senkrecht zur Ebene</translation>
    </message>
    <message>
        <source>Place of the plane</source>
        <translation>Lage der Ebene</translation>
    </message>
    <message>
        <source>Arrows in the volume</source>
        <translation>Pfeile im Volumen</translation>
    </message>
    <message>
        <source>Straightness and the second axis</source>
        <translation>Geradheit und zweite Achse</translation>
    </message>
    <message>
        <source>Along the bar / mm</source>
        <translation>Entlang der Leiste / mm</translation>
    </message>
    <message>
        <source>Off line / µm</source>
        <translation>Neben der Geraden / µm</translation>
    </message>
    <message>
        <source>Deviations from a straight line will appear here</source>
        <translation>Hier erscheinen die Abweichungen von einer Geraden</translation>
    </message>
    <message>
        <source>Fit all cycles: the deviation of the axis from uniform expansion is drawn for each hole.</source>
        <translation>Alle Zyklen anpassen: dargestellt wird je Loch, wie die Achse von einer gleichmäßigen Ausdehnung abweicht.</translation>
    </message>
    <message>
        <source>Second axis expands too</source>
        <translation>Auch die zweite Achse dehnt sich aus</translation>
    </message>
    <message>
        <source>One parameter more; needs a bar whose growth is known</source>
        <translation>Ein Parameter mehr; setzt eine Leiste mit bekannter Ausdehnung voraus</translation>
    </message>
    <message>
        <source>Known growth of the bar</source>
        <translation>Bekannte Ausdehnung der Leiste</translation>
    </message>
    <message>
        <source>Standard uncertainty of that growth</source>
        <translation>Standardunsicherheit dieser Ausdehnung</translation>
    </message>
    <message>
        <source>Expansion of the bar</source>
        <translation>Ausdehnung der Leiste</translation>
    </message>
    <message>
        <source>Effect of an undetected expansion of the second axis</source>
        <translation>Wirkung einer unbemerkten Ausdehnung der zweiten Achse</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Bias by the second axis</source>
        <translation>Systematische Abweichung durch die zweite Achse</translation>
    </message>
    <message>
        <source>The bias appears after the fit.</source>
        <translation>Nach der Anpassung erscheint hier die systematische Abweichung.</translation>
    </message>
    <message>
        <source>extend by the second axis</source>
        <translation>um die zweite Achse erweitern</translation>
    </message>
    <message>
        <source>growth of the bar</source>
        <translation>Ausdehnung der Leiste</translation>
    </message>
    <message>
        <source>uncertainty of the bar</source>
        <translation>Unsicherheit der Leiste</translation>
    </message>
    <message>
        <source>%1 at %2 = %3 mm in cycle %4 against %5, stylus %6</source>
        <translation>%1 bei %2 = %3 mm in Zyklus %4 gegen %5, Tastereinsatz %6</translation>
    </message>
    <message>
        <source>rms over all cycles</source>
        <translation>rms über alle Zyklen</translation>
    </message>
    <message>
        <source>Largest</source>
        <translation>Größte</translation>
    </message>
    <message>
        <source>Value / u</source>
        <translation>Wert / u</translation>
    </message>
    <message>
        <source>Change per 10⁻⁶</source>
        <translation>Änderung je 10⁻⁶</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::DiscrepancyPage</name>
    <message>
        <source>The rms falls from %1 to %2; the noise alone is %3.</source>
        <translation>Der Effektivwert (rms) sinkt von %1 auf %2; das Rauschen allein beträgt %3.</translation>
    </message>
    <message>
        <source>or</source>
        <translation>oder</translation>
    </message>
    <message>
        <source>one of %1</source>
        <translation>eines von %1</translation>
    </message>
    <message>
        <source>; and </source>
        <translation>; und </translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>These data cannot decide what is missing.</source>
        <translation>Diese Daten können nicht entscheiden, was fehlt.</translation>
    </message>
    <message>
        <source>Remainder: %1. </source>
        <translation>Rest: %1. </translation>
    </message>
    <message>
        <source>Measured and simulated agree within the noise.</source>
        <translation>Messung und Simulation stimmen innerhalb des Rauschens überein.</translation>
    </message>
    <message>
        <source>Measured and simulated differ by no more than a rough simulation may be off by.</source>
        <translation>Messung und Simulation unterscheiden sich nicht mehr, als eine grobe Simulation abweichen darf.</translation>
    </message>
    <message>
        <source>The rms is %1, the noise %2. Nothing is missing.</source>
        <translation>Der rms beträgt %1, das Rauschen %2. Es fehlt nichts.</translation>
    </message>
    <message>
        <source>Beside %1 something is missing that no effect of the catalogue explains.</source>
        <translation>Außer %1 fehlt etwas, das kein Effekt des Katalogs erklärt.</translation>
    </message>
    <message>
        <source>Something is missing that no effect of the catalogue explains.</source>
        <translation>Es fehlt etwas, das kein Effekt des Katalogs erklärt.</translation>
    </message>
    <message>
        <source>The rms is %1, the noise %2.</source>
        <translation>Der rms beträgt %1, das Rauschen %2.</translation>
    </message>
    <message>
        <source>With %1 something remains that cannot be named.</source>
        <translation>Mit %1 verbleibt etwas, das sich nicht benennen lässt.</translation>
    </message>
    <message>
        <source>With %1 the simulation agrees with the measurement.</source>
        <translation>Mit %1 stimmt die Simulation mit der Messung überein.</translation>
    </message>
    <message>
        <source>Beside %1 the simulation lacks: %2.</source>
        <translation>Außer %1 fehlt in der Simulation: %2.</translation>
    </message>
    <message>
        <source>The simulation lacks: %1.</source>
        <translation>In der Simulation fehlt: %1.</translation>
    </message>
    <message>
        <source>%1 that it is one of these</source>
        <translation>%1, dass es einer von diesen ist</translation>
    </message>
    <message>
        <source>Confidence %1 for the first. Adding all of them takes the rms from %2 to %3; the noise alone is %4. %5</source>
        <translation>Konfidenz %1 für den ersten Effekt. Das Hinzufügen aller senkt den Effektivwert (rms) von %2 auf %3; das Rauschen allein beträgt %4. %5</translation>
    </message>
    <message>
        <source>Confidence %1. Adding it takes the rms from %2 to %3; the noise alone is %4. %5</source>
        <translation>Konfidenz %1. Das Hinzufügen senkt den Effektivwert (rms) von %2 auf %3; das Rauschen allein beträgt %4. %5</translation>
    </message>
    <message>
        <source>Search</source>
        <translation>Suchen</translation>
    </message>
    <message>
        <source>Find where measurement and simulation disagree, and try every effect of the catalogue</source>
        <translation>Finden, wo Messung und Simulation voneinander abweichen, und jeden Effekt des Katalogs erproben</translation>
    </message>
    <message>
        <source>Effects</source>
        <translation>Effekte</translation>
    </message>
    <message>
        <source>All effects that the search knows for this machine: look at them, switch them off, write your own</source>
        <translation>Alle Effekte, die die Suche für diese Maschine kennt: ansehen, abschalten, eigene schreiben</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Add to the model</source>
        <translation>Zum Modell hinzufügen</translation>
    </message>
    <message>
        <source>Remove from the model</source>
        <translation>Aus dem Modell nehmen</translation>
    </message>
    <message>
        <source>What is missing</source>
        <translation>Was fehlt</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>Gap before and after</source>
        <translation>Differenz vorher und nachher</translation>
    </message>
    <message>
        <source>Open a session or a campaign first.</source>
        <translation>Zuerst eine Sitzung oder eine Kampagne öffnen.</translation>
    </message>
    <message>
        <source>This campaign comes without a simulation to compare with. Put simulation.csv or model.json beside campaign.json, name it there (&quot;simulation&quot;: &quot;simulation.csv&quot;) and open the campaign again.</source>
        <translation>Zu dieser Kampagne gehört keine Simulation, mit der verglichen werden kann. simulation.csv oder model.json neben campaign.json legen, dort nennen (&quot;simulation&quot;: &quot;simulation.csv&quot;) und die Kampagne erneut öffnen.</translation>
    </message>
    <message>
        <source>There are no observations to compare with the simulation. Evaluate the captures first (Calibrate).</source>
        <translation>Es gibt keine Beobachtungen, die mit der Simulation verglichen werden können. Zuerst die Aufnahmen auswerten (Kalibrieren).</translation>
    </message>
    <message>
        <source>Nothing to compare yet</source>
        <translation>Noch nichts zu vergleichen</translation>
    </message>
    <message>
        <source>What does the simulation lack?</source>
        <translation>Was fehlt in der Simulation?</translation>
    </message>
    <message>
        <source>Press Search: every effect of the catalogue is fitted to the residual between measurement and simulation. It takes a few seconds, can be cancelled, and changes nothing.</source>
        <translation>„Suchen“ drücken: jeder Effekt des Katalogs wird an das Residuum zwischen Messung und Simulation angepasst. Das dauert einige Sekunden, lässt sich abbrechen und ändert nichts.</translation>
    </message>
    <message>
        <source>What was found cannot be shown</source>
        <translation>Das Gefundene lässt sich nicht darstellen</translation>
    </message>
    <message>
        <source>Changed since this was found: %1.</source>
        <translation>Geändert, seit dies gefunden wurde: %1.</translation>
    </message>
    <message>
        <source>Search again</source>
        <translation>Erneut suchen</translation>
    </message>
    <message>
        <source>And %1 more.</source>
        <translation>Und %1 weitere.</translation>
    </message>
    <message>
        <source>The effect that is being edited has not been taken over.</source>
        <translation>Der Effekt in Bearbeitung wurde nicht übernommen.</translation>
    </message>
    <message>
        <source>Fitting again with the effects as they are now. What is shown is of before.</source>
        <translation>Neue Anpassung mit den jetzigen Effekten. Gezeigt wird der Stand davor.</translation>
    </message>
    <message>
        <source>add %1</source>
        <translation>%1 hinzufügen</translation>
    </message>
    <message>
        <source>remove %1</source>
        <translation>%1 entfernen</translation>
    </message>
    <message>
        <source>Add %1 and fit all parameters again</source>
        <translation>%1 hinzufügen und alle Parameter neu anpassen</translation>
    </message>
    <message>
        <source>leave out %1</source>
        <translation>%1 auslassen</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>What remains</source>
        <translation>Was verbleibt</translation>
    </message>
    <message>
        <source>What to measure next</source>
        <translation>Was als Nächstes zu messen ist</translation>
    </message>
    <message>
        <source>Into the simulation</source>
        <translation>In die Simulation</translation>
    </message>
    <message>
        <source>Exclude readings</source>
        <translation>Messwerte ausschließen</translation>
    </message>
    <message>
        <source>Why are the readings %1 (state/point/component) left out? The report will say so.</source>
        <translation>Warum werden die Messwerte %1 (Zustand/Punkt/Komponente) ausgelassen? Der Grund steht im Bericht.</translation>
    </message>
    <message>
        <source> and %1 more</source>
        <translation> und %1 weitere</translation>
    </message>
    <message>
        <source>outlier</source>
        <translation>Ausreißer</translation>
    </message>
    <message>
        <source>Discrepancy</source>
        <translation>Diskrepanz</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::EffectEditor</name>
    <message>
        <source>Id</source>
        <translation>Kennung</translation>
    </message>
    <message>
        <source>A stable name in lower case; results, models and reports use it</source>
        <translation>Ein beständiger Name in Kleinbuchstaben; Ergebnisse, Modelle und Berichte verwenden ihn</translation>
    </message>
    <message>
        <source>Title</source>
        <translation>Titel</translation>
    </message>
    <message>
        <source>collimation error of the tube</source>
        <translation>Kollimationsfehler des Tubus</translation>
    </message>
    <message>
        <source>What people call it, as it stands in a sentence</source>
        <translation>Die übliche Bezeichnung, wie sie in einem Satz steht</translation>
    </message>
    <message>
        <source>What happens in the machine, in one sentence</source>
        <translation>Was in der Maschine geschieht, in einem Satz</translation>
    </message>
    <message>
        <source>Physics</source>
        <translation>Physik</translation>
    </message>
    <message>
        <source>What drives it</source>
        <translation>Was ihn antreibt</translation>
    </message>
    <message>
        <source>Drivers</source>
        <translation>Antriebsgrößen</translation>
    </message>
    <message>
        <source>none: constant</source>
        <translation>keine: konstant</translation>
    </message>
    <message>
        <source>Add a column of the log</source>
        <translation>Spalte des Protokolls hinzufügen</translation>
    </message>
    <message>
        <source>Columns of log.csv, with a power if need be (spindle_rpm^1.5). A comma separates alternatives; a plus sign between spaces joins inputs that act together, each with a gain of its own.</source>
        <translation>Spalten von log.csv, bei Bedarf mit Potenz (spindle_rpm^1.5). Ein Komma trennt Alternativen; ein Pluszeichen zwischen Leerzeichen verbindet Eingangsgrößen, die gemeinsam wirken, jede mit eigener Verstärkung.</translation>
    </message>
    <message>
        <source>none: at once</source>
        <translation>keine: sofort</translation>
    </message>
    <message>
        <source>first-order time constant</source>
        <translation>Zeitkonstante erster Ordnung</translation>
    </message>
    <message>
        <source>step at an unknown time</source>
        <translation>Sprung zu unbekannter Zeit</translation>
    </message>
    <message>
        <source>pulse at an unknown time</source>
        <translation>Puls zu unbekannter Zeit</translation>
    </message>
    <message>
        <source>Dynamics</source>
        <translation>Dynamik</translation>
    </message>
    <message>
        <source>Shortest time constant / s</source>
        <translation>Kleinste Zeitkonstante / s</translation>
    </message>
    <message>
        <source>Longest time constant / s</source>
        <translation>Größte Zeitkonstante / s</translation>
    </message>
    <message>
        <source>as the data allow</source>
        <translation>frei</translation>
    </message>
    <message>
        <source>to</source>
        <translation>bis</translation>
    </message>
    <message>
        <source>Time constant</source>
        <translation>Zeitkonstante</translation>
    </message>
    <message>
        <source>Shape: deviation of the tool for a gain of one</source>
        <translation>Form: Abweichung des Werkzeugs bei Verstärkung eins</translation>
    </message>
    <message>
        <source>Expressions in x, y, z / mm, c / rad, dirx, diry, dirz (direction of approach, ±1); EX, EY, EZ in µm, EA, EB, EC in µrad. An empty field is zero.</source>
        <translation>Ausdrücke in x, y, z / mm, c / rad, dirx, diry, dirz (Anfahrrichtung, ±1); EX, EY, EZ in µm, EA, EB, EC in µrad. Ein leeres Feld ist null.</translation>
    </message>
    <message>
        <source>Add a gain</source>
        <translation>Verstärkung hinzufügen</translation>
    </message>
    <message>
        <source>One more amplitude that is fitted by itself, with expressions of its own</source>
        <translation>Eine weitere Amplitude, die für sich angepasst wird, mit eigenen Ausdrücken</translation>
    </message>
    <message>
        <source>either</source>
        <translation>beide</translation>
    </message>
    <message>
        <source>positive for more of the driver</source>
        <translation>positiv bei mehr Antrieb</translation>
    </message>
    <message>
        <source>negative for more of the driver</source>
        <translation>negativ bei mehr Antrieb</translation>
    </message>
    <message>
        <source>Sign of the first gain</source>
        <translation>Vorzeichen der ersten Verstärkung</translation>
    </message>
    <message>
        <source>Sign of gain 1</source>
        <translation>Vorzeichen der Verstärkung 1</translation>
    </message>
    <message>
        <source>Contains</source>
        <translation>Enthält</translation>
    </message>
    <message>
        <source>ids of simpler effects, separated by commas</source>
        <translation>Kennungen, durch Kommas getrennt</translation>
    </message>
    <message>
        <source>Effects that are special cases of this one; they are named instead where they are sufficient</source>
        <translation>Effekte, die Sonderfälle von diesem sind; sie werden stattdessen genannt, wo sie genügen</translation>
    </message>
    <message>
        <source>Where the physics is described, one a line</source>
        <translation>Wo die Physik beschrieben ist, eine Quelle je Zeile</translation>
    </message>
    <message>
        <source>References</source>
        <translation>Literatur</translation>
    </message>
    <message>
        <source>Add a column</source>
        <translation>Spalte hinzufügen</translation>
    </message>
    <message>
        <source>Gain %1</source>
        <translation>Verstärkung %1</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Unit of gain %1</source>
        <translation>Einheit der Verstärkung %1</translation>
    </message>
    <message>
        <source>Of the gain alone, as it is written in results: um, urad, um_per_m</source>
        <translation>Der Verstärkung allein, wie in Ergebnissen geschrieben: um, urad, um_per_m</translation>
    </message>
    <message>
        <source>Remove gain</source>
        <translation>Verstärkung entfernen</translation>
    </message>
    <message>
        <source>%1 of gain %2</source>
        <translation>%1 der Verstärkung %2</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::EffectPicture</name>
    <message>
        <source>Top</source>
        <translation>Oben</translation>
    </message>
    <message>
        <source>Front</source>
        <translation>Vorn</translation>
    </message>
    <message>
        <source>Side</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>Shape of the effect on the machine</source>
        <translation>Form des Effekts an der Maschine</translation>
    </message>
    <message>
        <source>This effect has no shape of its own.</source>
        <translation>Dieser Effekt hat keine eigene Form.</translation>
    </message>
    <message>
        <source>The shape is zero, or has no value, everywhere in the working volume.</source>
        <translation>Die Form ist im gesamten Arbeitsraum null oder ohne Wert.</translation>
    </message>
    <message>
        <source>Largest deviation for a gain of 1 %1: %2</source>
        <translation>Größte Abweichung bei Verstärkung 1 %1: %2</translation>
    </message>
    <message>
        <source>%1, colour %2</source>
        <translation>%1, Farbe %2</translation>
    </message>
    <message>
        <source>Rotation of the tool for a gain of 1 %1, as vectors: at most %2.</source>
        <translation>Drehung des Werkzeugs bei Verstärkung 1 %1, als Vektoren: höchstens %2.</translation>
    </message>
    <message>
        <source>Deviation of the tool for a gain of 1 %1, drawn exaggerated: at most %2.</source>
        <translation>Abweichung des Werkzeugs bei Verstärkung 1 %1, überhöht gezeichnet: höchstens %2.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::EffectsPanel</name>
    <message>
        <source>switched off: it is not named</source>
        <translation>abgeschaltet: wird nicht benannt</translation>
    </message>
    <message>
        <source>in the model</source>
        <translation>im Modell</translation>
    </message>
    <message>
        <source>cannot be tried: nothing that these data hold drives it</source>
        <translation>nicht prüfbar: nichts in diesen Daten treibt ihn an</translation>
    </message>
    <message>
        <source>is tried</source>
        <translation>wird geprüft</translation>
    </message>
    <message>
        <source>Physics</source>
        <translation>Physik</translation>
    </message>
    <message>
        <source>In the search</source>
        <translation>In der Suche</translation>
    </message>
    <message>
        <source>Id</source>
        <translation>Kennung</translation>
    </message>
    <message>
        <source>Formula</source>
        <translation>Formel</translation>
    </message>
    <message>
        <source>; positive for more of the driver</source>
        <translation>; positiv bei mehr Antrieb</translation>
    </message>
    <message>
        <source>; negative for more of the driver</source>
        <translation>; negativ bei mehr Antrieb</translation>
    </message>
    <message>
        <source>Unit of gain</source>
        <translation>Einheit der Verstärkung</translation>
    </message>
    <message>
        <source>Driven by</source>
        <translation>Angetrieben von</translation>
    </message>
    <message>
        <source>nothing that this log holds: it cannot be tried</source>
        <translation>nichts, was dieses Protokoll enthält: nicht prüfbar</translation>
    </message>
    <message>
        <source>nothing that is logged</source>
        <translation>nichts Protokolliertes</translation>
    </message>
    <message>
        <source>, time constant %1 s to %2 s</source>
        <translation>, Zeitkonstante %1 s bis %2 s</translation>
    </message>
    <message>
        <source>Dynamics</source>
        <translation>Dynamik</translation>
    </message>
    <message>
        <source>Contains</source>
        <translation>Enthält</translation>
    </message>
    <message>
        <source>See</source>
        <translation>Siehe</translation>
    </message>
    <message>
        <source>Gain %1 of %2</source>
        <translation>Verstärkung %1 von %2</translation>
    </message>
    <message>
        <source>Effects of this machine</source>
        <translation>Effekte dieser Maschine</translation>
    </message>
    <message>
        <source>Search in titles, physics, formulas and drivers</source>
        <translation>In Titeln, Physik, Formeln und Antriebsgrößen suchen</translation>
    </message>
    <message>
        <source>Search the effects</source>
        <translation>Effekte durchsuchen</translation>
    </message>
    <message>
        <source>Effects</source>
        <translation>Effekte</translation>
    </message>
    <message>
        <source>Use the built-in effects too</source>
        <translation>Auch die eingebauten Effekte verwenden</translation>
    </message>
    <message>
        <source>Off: the search tries your own effects alone, for a device that is not a machine tool</source>
        <translation>Aus: die Suche prüft nur die eigenen Effekte, für ein Gerät, das keine Werkzeugmaschine ist</translation>
    </message>
    <message>
        <source>New effect …</source>
        <translation>Neuer Effekt …</translation>
    </message>
    <message>
        <source>Load …</source>
        <translation>Laden …</translation>
    </message>
    <message>
        <source>Reads effects.json in place of your own effects as they are here</source>
        <translation>Liest effects.json an Stelle der eigenen Effekte, wie sie hier stehen</translation>
    </message>
    <message>
        <source>Save as …</source>
        <translation>Speichern unter …</translation>
    </message>
    <message>
        <source>Writes your own effects as effects.json, for campaign.json or the command line</source>
        <translation>Schreibt die eigenen Effekte als effects.json, für campaign.json oder die Kommandozeile</translation>
    </message>
    <message>
        <source>Back to the campaign&apos;s</source>
        <translation>Zurück zu denen der Kampagne</translation>
    </message>
    <message>
        <source>Drops the effects as edited here; those that campaign.json names are used again</source>
        <translation>Verwirft die hier bearbeiteten Effekte; es gelten wieder die in campaign.json genannten</translation>
    </message>
    <message>
        <source>Gain that is drawn</source>
        <translation>Gezeichnete Verstärkung</translation>
    </message>
    <message>
        <source>Edit …</source>
        <translation>Bearbeiten …</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>There is no effect of your own yet: without the built-in ones the search would have nothing to try. Write or load one first.</source>
        <translation>Es gibt noch keinen eigenen Effekt: ohne die eingebauten hätte die Suche nichts zu prüfen. Zuerst einen schreiben oder laden.</translation>
    </message>
    <message>
        <source>use the built-in effects</source>
        <translation>eingebaute Effekte verwenden</translation>
    </message>
    <message>
        <source>leave out the built-in effects</source>
        <translation>eingebaute Effekte auslassen</translation>
    </message>
    <message>
        <source>Load effects</source>
        <translation>Effekte laden</translation>
    </message>
    <message>
        <source>Effects (*.json)</source>
        <translation>Effekte (*.json)</translation>
    </message>
    <message>
        <source>Save effects</source>
        <translation>Effekte speichern</translation>
    </message>
    <message>
        <source>go back to the campaign&apos;s effects</source>
        <translation>zu den Effekten der Kampagne zurückkehren</translation>
    </message>
    <message>
        <source>listing …</source>
        <translation>wird aufgelistet …</translation>
    </message>
    <message>
        <source>Your own</source>
        <translation>Eigene</translation>
    </message>
    <message>
        <source>switch effects on and off</source>
        <translation>Effekte an- und abschalten</translation>
    </message>
    <message>
        <source>leave out %1</source>
        <translation>%1 auslassen</translation>
    </message>
    <message>
        <source>consider %1 again</source>
        <translation>%1 wieder berücksichtigen</translation>
    </message>
    <message>
        <source>Effect</source>
        <translation>Effekt</translation>
    </message>
    <message>
        <source>The shape of an effect on the machine appears here when you choose one in the list.</source>
        <translation>Hier erscheint die Form eines Effekts an der Maschine, sobald einer in der Liste gewählt ist.</translation>
    </message>
    <message>
        <source>remove %1</source>
        <translation>%1 entfernen</translation>
    </message>
    <message>
        <source>load effects</source>
        <translation>Effekte laden</translation>
    </message>
    <message>
        <source>Saved as %1.</source>
        <translation>Gespeichert als %1.</translation>
    </message>
    <message>
        <source>Shape on the machine</source>
        <translation>Form an der Maschine</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Übernehmen</translation>
    </message>
    <message>
        <source>Puts the effect into the list; the next search tries it</source>
        <translation>Nimmt den Effekt in die Liste auf; die nächste Suche prüft ihn</translation>
    </message>
    <message>
        <source>New effect</source>
        <translation>Neuer Effekt</translation>
    </message>
    <message>
        <source>Effect %1</source>
        <translation>Effekt %1</translation>
    </message>
    <message>
        <source>The shape appears here as soon as its expressions can be read.</source>
        <translation>Die Form erscheint hier, sobald die Ausdrücke lesbar sind.</translation>
    </message>
    <message>
        <source>Give an id and at least one expression. Everything is checked while you type.</source>
        <translation>Eine Kennung und mindestens einen Ausdruck angeben. Alles wird beim Tippen geprüft.</translation>
    </message>
    <message>
        <source>Not right yet: see the field that is marked.</source>
        <translation>Noch nicht richtig: siehe das markierte Feld.</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>It can be read. There are no observations yet to evaluate it at.</source>
        <translation>Lesbar. Es gibt noch keine Beobachtungen, an denen er ausgewertet werden kann.</translation>
    </message>
    <message>
        <source>add the effect %1</source>
        <translation>Effekt %1 hinzufügen</translation>
    </message>
    <message>
        <source>edit the effect %1</source>
        <translation>Effekt %1 bearbeiten</translation>
    </message>
    <message>
        <source>Shape of the effect</source>
        <translation>Form des Effekts</translation>
    </message>
    <message numerus="yes">
        <source>%n effects</source>
        <translation>
            <numerusform>%n Effekt</numerusform>
            <numerusform>%n Effekte</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>It can be read, and has a value at all %n points observed.</source>
        <translation>
            <numerusform>Lesbar, und am einzigen beobachteten Punkt hat er einen Wert.</numerusform>
            <numerusform>Lesbar, und an allen %n beobachteten Punkten hat er einen Wert.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1 of %n effects</source>
        <translation>
            <numerusform>%1 von %n Effekt</numerusform>
            <numerusform>%1 von %n Effekten</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>leave out %n effects</source>
        <translation>
            <numerusform>%n Effekt auslassen</numerusform>
            <numerusform>%n Effekte auslassen</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>consider %n effects again</source>
        <translation>
            <numerusform>%n Effekt wieder berücksichtigen</numerusform>
            <numerusform>%n Effekte wieder berücksichtigen</numerusform>
        </translation>
    </message>
    <message>
        <source>An effect was being edited while the effects were others. Show it: it can be applied to these, or cancelled.</source>
        <translation>Ein Effekt wurde bearbeitet, als die Effekte andere waren. Nach dem Anzeigen kann er auf diese angewendet oder abgebrochen werden.</translation>
    </message>
    <message>
        <source>Show it</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>change an effect</source>
        <translation>Effekt ändern</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ExerciseDialog</name>
    <message>
        <source>Medium</source>
        <translation>Mittel</translation>
    </message>
    <message>
        <source>Hard</source>
        <translation>Schwer</translation>
    </message>
    <message>
        <source>Easy</source>
        <translation>Leicht</translation>
    </message>
    <message>
        <source>nothing in the log</source>
        <translation>nichts im Protokoll</translation>
    </message>
    <message>
        <source>What is missing is largest in: %1</source>
        <translation>Was fehlt, ist am größten in: %1</translation>
    </message>
    <message>
        <source>Driven by: %1</source>
        <translation>Angetrieben von: %1</translation>
    </message>
    <message>
        <source>Family: %1</source>
        <translation>Familie: %1</translation>
    </message>
    <message>
        <source>Exercise: find the missing effect</source>
        <translation>Übung: den fehlenden Effekt finden</translation>
    </message>
    <message>
        <source>The simulation of a machine lacks something. Look at residuals, log and maps in the window, name what is missing, and only then run the search.</source>
        <translation>In der Simulation einer Maschine fehlt etwas. Residuen, Protokoll und Karten im Fenster ansehen, das Fehlende benennen und erst dann die Suche starten.</translation>
    </message>
    <message>
        <source>New exercise</source>
        <translation>Neue Übung</translation>
    </message>
    <message>
        <source>Level</source>
        <translation>Stufe</translation>
    </message>
    <message>
        <source>One effect of ten times the noise</source>
        <translation>Ein Effekt vom Zehnfachen des Rauschens</translation>
    </message>
    <message>
        <source>Two effects of six times the noise; states shifted as a whole</source>
        <translation>Zwei Effekte vom Sechsfachen des Rauschens; Zustände als Ganzes verschoben</translation>
    </message>
    <message>
        <source>Three effects of four times the noise, as a workshop leaves its data</source>
        <translation>Drei Effekte vom Vierfachen des Rauschens, mit Daten, wie sie eine Werkstatt hinterlässt</translation>
    </message>
    <message>
        <source>Number </source>
        <translation>Nummer </translation>
    </message>
    <message>
        <source>Number of the exercise</source>
        <translation>Nummer der Übung</translation>
    </message>
    <message>
        <source>The same number and level give the same exercise</source>
        <translation>Gleiche Nummer und Stufe ergeben dieselbe Übung</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Starten</translation>
    </message>
    <message>
        <source>Your answer</source>
        <translation>Eigene Antwort</translation>
    </message>
    <message>
        <source>Show a hint (−%1)</source>
        <translation>Hinweis anzeigen (−%1)</translation>
    </message>
    <message>
        <source>Compare with the search</source>
        <translation>Mit der Suche vergleichen</translation>
    </message>
    <message>
        <source>Give the answer</source>
        <translation>Antwort abgeben</translation>
    </message>
    <message>
        <source>Hidden</source>
        <translation>Verborgen</translation>
    </message>
    <message>
        <source>Named</source>
        <translation>Benannt</translation>
    </message>
    <message>
        <source>Driver</source>
        <translation>Antriebsgröße</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Größe</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Zeitpunkt</translation>
    </message>
    <message>
        <source>Number</source>
        <translation>Nummer</translation>
    </message>
    <message>
        <source>Score</source>
        <translation>Punktzahl</translation>
    </message>
    <message>
        <source>Hints</source>
        <translation>Hinweise</translation>
    </message>
    <message>
        <source>What was hidden</source>
        <translation>Was verborgen war</translation>
    </message>
    <message>
        <source>What was hidden appears here after your answer.</source>
        <translation>Was verborgen war, erscheint hier nach der Antwort.</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Ergebnis</translation>
    </message>
    <message>
        <source>Earlier exercises</source>
        <translation>Frühere Übungen</translation>
    </message>
    <message>
        <source>Exercises that were marked appear here.</source>
        <translation>Bewertete Übungen erscheinen hier.</translation>
    </message>
    <message>
        <source>History</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Start an exercise: its campaign is opened as if it had been measured.</source>
        <translation>Eine Übung starten: ihre Kampagne wird geöffnet, als wäre sie gemessen worden.</translation>
    </message>
    <message>
        <source>%1, number %2. Hidden effects: %3. Size is the largest change at one point.</source>
        <translation>%1, Nummer %2. Verborgene Effekte: %3. Die Größe ist die größte Änderung an einem Punkt.</translation>
    </message>
    <message>
        <source>Reading the effects of the machine</source>
        <translation>Effekte der Maschine werden gelesen</translation>
    </message>
    <message>
        <source>Family of effect %1</source>
        <translation>Familie des Effekts %1</translation>
    </message>
    <message>
        <source>Effect %1</source>
        <translation>Effekt %1</translation>
    </message>
    <message>
        <source>Driver of effect %1</source>
        <translation>Antriebsgröße des Effekts %1</translation>
    </message>
    <message>
        <source>Size of effect %1</source>
        <translation>Größe des Effekts %1</translation>
    </message>
    <message>
        <source>size not given</source>
        <translation>Größe nicht angegeben</translation>
    </message>
    <message>
        <source>Family …</source>
        <translation>Familie …</translation>
    </message>
    <message>
        <source>Effect …</source>
        <translation>Effekt …</translation>
    </message>
    <message>
        <source>Driver …</source>
        <translation>Antriebsgröße …</translation>
    </message>
    <message>
        <source>Nothing in the log</source>
        <translation>Nichts im Protokoll</translation>
    </message>
    <message>
        <source>Looking up the hint</source>
        <translation>Hinweis wird nachgeschlagen</translation>
    </message>
    <message>
        <source>Marking the answer</source>
        <translation>Antwort wird bewertet</translation>
    </message>
    <message>
        <source>%1 in %2</source>
        <translation>%1 in %2</translation>
    </message>
    <message>
        <source>no</source>
        <translation>nein</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>nearly: %1</source>
        <translation>beinahe: %1</translation>
    </message>
    <message>
        <source>not there: %1</source>
        <translation>nicht vorhanden: %1</translation>
    </message>
    <message>
        <source>%1 of 100.</source>
        <translation>%1 von 100.</translation>
    </message>
    <message>
        <source>Hints used: %1.</source>
        <translation>Genutzte Hinweise: %1.</translation>
    </message>
    <message>
        <source>The search had been run before: half the marks.</source>
        <translation>Die Suche war zuvor ausgeführt worden: halbe Punktzahl.</translation>
    </message>
    <message>
        <source>Kind of the size of effect %1</source>
        <translation>Art der Größe des Effekts %1</translation>
    </message>
    <message>
        <source>Displacement</source>
        <translation>Verschiebung</translation>
    </message>
    <message>
        <source>Rotation</source>
        <translation>Drehung</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ExportDialog</name>
    <message>
        <source>Export</source>
        <translation>Exportieren</translation>
    </message>
    <message>
        <source>Pictures and tables of this page</source>
        <translation>Bilder und Tabellen dieser Seite</translation>
    </message>
    <message>
        <source>What to export</source>
        <translation>Was exportiert wird</translation>
    </message>
    <message>
        <source>Format of %1</source>
        <translation>Format von %1</translation>
    </message>
    <message>
        <source>Folder</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>Folder to export to</source>
        <translation>Zielordner des Exports</translation>
    </message>
    <message>
        <source>Choose …</source>
        <translation>Wählen …</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Writing %1 … Close cancels.</source>
        <translation>%1 wird geschrieben … „Schließen“ bricht ab.</translation>
    </message>
    <message>
        <source>Cancelled; files written before: %1</source>
        <translation>Abgebrochen; zuvor geschriebene Dateien: %1</translation>
    </message>
    <message>
        <source>Files written to %1: %2</source>
        <translation>Dateien nach %1 geschrieben: %2</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::FiducialCalibratePage</name>
    <message>
        <source>Evaluate the captures</source>
        <translation>Aufnahmen auswerten</translation>
    </message>
    <message>
        <source>Pixel length</source>
        <translation>Pixelgröße</translation>
    </message>
    <message>
        <source>Centre of rotation in the image</source>
        <translation>Drehzentrum im Bild</translation>
    </message>
    <message>
        <source>Angle from X to Y</source>
        <translation>Winkel von X nach Y</translation>
    </message>
    <message>
        <source>Captures left out</source>
        <translation>Ausgelassene Aufnahmen</translation>
    </message>
    <message>
        <source>Fiducial</source>
        <translation>Messmarke</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>EX / µm</source>
        <translation>EX / µm</translation>
    </message>
    <message>
        <source>EY / µm</source>
        <translation>EY / µm</translation>
    </message>
    <message>
        <source>EZ / µm</source>
        <translation>EZ / µm</translation>
    </message>
    <message>
        <source>Deviations</source>
        <translation>Abweichungen</translation>
    </message>
    <message>
        <source>Deviations of each fiducial appear after the evaluation.</source>
        <translation>Nach der Auswertung erscheinen hier die Abweichungen jeder Messmarke.</translation>
    </message>
    <message>
        <source>Centre x / px</source>
        <translation>Zentrum x / px</translation>
    </message>
    <message>
        <source>Centre y / px</source>
        <translation>Zentrum y / px</translation>
    </message>
    <message>
        <source>Scatter / µm</source>
        <translation>Streuung / µm</translation>
    </message>
    <message>
        <source>Sets</source>
        <translation>Sätze</translation>
    </message>
    <message>
        <source>Centres, directions and heights appear after the evaluation.</source>
        <translation>Nach der Auswertung erscheinen hier Zentren, Richtungen und Höhen.</translation>
    </message>
    <message>
        <source>Capture</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Why it was left out</source>
        <translation>Grund des Auslassens</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>Ausgelassen</translation>
    </message>
    <message>
        <source>Nothing was left out.</source>
        <translation>Es wurde nichts ausgelassen.</translation>
    </message>
    <message>
        <source>What the states are</source>
        <translation>Was die Zustände sind</translation>
    </message>
    <message>
        <source>The states are thermal states: nothing to check</source>
        <translation>Die Zustände sind thermische Zustände: nichts zu prüfen</translation>
    </message>
    <message>
        <source>Jogs within one resolution</source>
        <translation>Schritte innerhalb einer Auflösung</translation>
    </message>
    <message>
        <source>Cold repeatability within half the resolution</source>
        <translation>Wiederholpräzision kalt: innerhalb der halben Auflösung</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Largest / µm</source>
        <translation>Größte / µm</translation>
    </message>
    <message>
        <source>At</source>
        <translation>Bei</translation>
    </message>
    <message>
        <source>rms / µm</source>
        <translation>rms / µm</translation>
    </message>
    <message>
        <source>Allowed / µm</source>
        <translation>Zulässig / µm</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Check against the resolution</source>
        <translation>Prüfung gegen die Auflösung</translation>
    </message>
    <message>
        <source>Say what the states are to compare them with the resolution of the axes.</source>
        <translation>Angeben, was die Zustände sind, um sie mit der Auflösung der Achsen zu vergleichen.</translation>
    </message>
    <message>
        <source>Resolution</source>
        <translation>Auflösung</translation>
    </message>
    <message>
        <source>Contrast over height</source>
        <translation>Kontrast über der Höhe</translation>
    </message>
    <message>
        <source>Fiducial whose contrast curves are shown</source>
        <translation>Messmarke, deren Kontrastkurven gezeigt werden</translation>
    </message>
    <message>
        <source>Commanded height / µm</source>
        <translation>Sollhöhe / µm</translation>
    </message>
    <message>
        <source>Contrast, normalised</source>
        <translation>Kontrast, normiert</translation>
    </message>
    <message>
        <source>Contrast curves will appear here</source>
        <translation>Hier erscheinen die Kontrastkurven</translation>
    </message>
    <message>
        <source>Evaluate the captures: the peak of each curve is the height of its fiducial.</source>
        <translation>Aufnahmen auswerten: das Maximum jeder Kurve ist die Höhe ihrer Messmarke.</translation>
    </message>
    <message>
        <source>Press Evaluate the captures. Those that cannot be used are listed with the reason, the others are evaluated.</source>
        <translation>„Aufnahmen auswerten“ drücken. Unbrauchbare werden mit Grund aufgeführt, die übrigen ausgewertet.</translation>
    </message>
    <message>
        <source>Changed since this was evaluated: %1. Evaluate again.</source>
        <translation>Geändert seit der Auswertung: %1. Erneut auswerten.</translation>
    </message>
    <message>
        <source> And %1 more.</source>
        <translation> Und %1 weitere.</translation>
    </message>
    <message>
        <source>Deviations found: %1, no warnings.</source>
        <translation>Gefundene Abweichungen: %1, keine Warnungen.</translation>
    </message>
    <message>
        <source>Left out (%1)</source>
        <translation>Ausgelassen (%1)</translation>
    </message>
    <message>
        <source>every capture was used</source>
        <translation>alle Aufnahmen wurden verwendet</translation>
    </message>
    <message>
        <source>see the list</source>
        <translation>siehe Liste</translation>
    </message>
    <message>
        <source>passed</source>
        <translation>bestanden</translation>
    </message>
    <message>
        <source>not passed</source>
        <translation>nicht bestanden</translation>
    </message>
    <message>
        <source>from the pattern itself</source>
        <translation>aus dem Muster selbst</translation>
    </message>
    <message>
        <source>± %1 px, %2; spindle repeats to %3 µm</source>
        <translation>± %1 px, %2; Wiederholpräzision der Spindel %3 µm</translation>
    </message>
    <message>
        <source>needs three spindle orientations</source>
        <translation>setzt drei Spindelstellungen voraus</translation>
    </message>
    <message>
        <source>deviation from 90°, mean of all fiducials</source>
        <translation>Abweichung von 90°, Mittel aller Messmarken</translation>
    </message>
    <message>
        <source>needs positions along both axes</source>
        <translation>setzt Positionen entlang beider Achsen voraus</translation>
    </message>
    <message>
        <source>state %1</source>
        <translation>Zustand %1</translation>
    </message>
    <message>
        <source>Contrast curves</source>
        <translation>Kontrastkurven</translation>
    </message>
    <message>
        <source>Joint x / px</source>
        <translation>Gemeinsam x / px</translation>
    </message>
    <message>
        <source>Joint y / px</source>
        <translation>Gemeinsam y / px</translation>
    </message>
    <message>
        <source>Circles x / px</source>
        <translation>Kreise x / px</translation>
    </message>
    <message>
        <source>Circles y / px</source>
        <translation>Kreise y / px</translation>
    </message>
    <message>
        <source>Off in x / µm</source>
        <translation>Abstand in x / µm</translation>
    </message>
    <message>
        <source>Off in y / µm</source>
        <translation>Abstand in y / µm</translation>
    </message>
    <message>
        <source>Tracks</source>
        <translation>Bahnen</translation>
    </message>
    <message>
        <source>Circles</source>
        <translation>Kreise</translation>
    </message>
    <message>
        <source>No mark was seen in enough spindle orientations for a circle through its track.</source>
        <translation>Kein Musterpunkt wurde in genügend Spindelorientierungen gesehen, um einen Kreis durch seine Bahn zu legen.</translation>
    </message>
    <message>
        <source>X to Y − 90° / µrad</source>
        <translation>X zu Y − 90° / µrad</translation>
    </message>
    <message>
        <source>Peak / µm</source>
        <translation>Maximum / µm</translation>
    </message>
    <message>
        <source>Algebraic circles through the tracks of the marks lie %1, %2 µm from the joint evaluation in the mean, scatter %3, %4 µm: short arcs pull them. They are shown for comparison and not used.</source>
        <translation>Algebraische Kreise durch die Bahnen der Musterpunkte liegen im Mittel %1, %2 µm neben der gemeinsamen Auswertung, Streuung %3, %4 µm: kurze Bögen verfälschen sie. Sie stehen zum Vergleich da und werden nicht verwendet.</translation>
    </message>
    <message>
        <source>Reading the contrast curves</source>
        <translation>Kontrastkurven werden gelesen</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::FiducialCapturePage</name>
    <message>
        <source>rotation</source>
        <translation>Drehung</translation>
    </message>
    <message>
        <source>along X</source>
        <translation>entlang X</translation>
    </message>
    <message>
        <source>along Y</source>
        <translation>entlang Y</translation>
    </message>
    <message>
        <source>focus</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source>Check all captures</source>
        <translation>Alle Aufnahmen prüfen</translation>
    </message>
    <message>
        <source>Captures</source>
        <translation>Aufnahmen</translation>
    </message>
    <message>
        <source>Thermal state</source>
        <translation>Thermischer Zustand</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>All verdicts</source>
        <translation>Alle Urteile</translation>
    </message>
    <message>
        <source>Good</source>
        <translation>Gut</translation>
    </message>
    <message>
        <source>Bad</source>
        <translation>Schlecht</translation>
    </message>
    <message>
        <source>Not checked</source>
        <translation>Nicht geprüft</translation>
    </message>
    <message>
        <source>Excluded</source>
        <translation>Ausgeschlossen</translation>
    </message>
    <message>
        <source>Capture</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Role</source>
        <translation>Rolle</translation>
    </message>
    <message>
        <source>Blur / px</source>
        <translation>Unschärfe / px</translation>
    </message>
    <message>
        <source>No capture has this state and verdict.</source>
        <translation>Keine Aufnahme hat diesen Zustand und dieses Urteil.</translation>
    </message>
    <message>
        <source>Plan: taken of needed</source>
        <translation>Plan: aufgenommen von nötig</translation>
    </message>
    <message>
        <source>Fiducial</source>
        <translation>Messmarke</translation>
    </message>
    <message>
        <source>Rotation</source>
        <translation>Drehung</translation>
    </message>
    <message>
        <source>X</source>
        <translation>X</translation>
    </message>
    <message>
        <source>Y</source>
        <translation>Y</translation>
    </message>
    <message>
        <source>Focus</source>
        <translation>Fokus</translation>
    </message>
    <message>
        <source>Plan</source>
        <translation>Plan</translation>
    </message>
    <message>
        <source>The plan appears with the first capture.</source>
        <translation>Der Plan erscheint mit der ersten Aufnahme.</translation>
    </message>
    <message>
        <source>Image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>The image will appear here</source>
        <translation>Hier erscheint das Bild</translation>
    </message>
    <message>
        <source>Choose a capture in the list. What was decoded is drawn on top.</source>
        <translation>Aufnahme in der Liste wählen. Das Decodierte wird darüber gezeichnet.</translation>
    </message>
    <message>
        <source>Exclude …</source>
        <translation>Ausschließen …</translation>
    </message>
    <message>
        <source>Overlay</source>
        <translation>Überlagerung</translation>
    </message>
    <message>
        <source>Whole image</source>
        <translation>Ganzes Bild</translation>
    </message>
    <message>
        <source>All states</source>
        <translation>Alle Zustände</translation>
    </message>
    <message>
        <source>State %1</source>
        <translation>Zustand %1</translation>
    </message>
    <message>
        <source>The campaign lists no captures yet.</source>
        <translation>Die Kampagne führt noch keine Aufnahmen auf.</translation>
    </message>
    <message>
        <source>%1 in state %2 has %3 for %4</source>
        <translation>%1 in Zustand %2 hat %3 für %4</translation>
    </message>
    <message>
        <source> Too few: %1.</source>
        <translation> Zu wenige: %1.</translation>
    </message>
    <message>
        <source>%1 in state %2, %3 %4</source>
        <translation>%1 in Zustand %2, %3 %4</translation>
    </message>
    <message>
        <source>Show it</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>excluded</source>
        <translation>ausgeschlossen</translation>
    </message>
    <message>
        <source>not checked</source>
        <translation>nicht geprüft</translation>
    </message>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>bad</source>
        <translation>schlecht</translation>
    </message>
    <message>
        <source>as before</source>
        <translation>wie zuvor</translation>
    </message>
    <message>
        <source>Directions of the axes are measured once, in the reference state.</source>
        <translation>Die Richtungen der Achsen werden einmal gemessen, im Referenzzustand.</translation>
    </message>
    <message>
        <source>Excluded: %1</source>
        <translation>Ausgeschlossen: %1</translation>
    </message>
    <message>
        <source>%1, state %2, %3 %4, spindle %5°, z %6 mm</source>
        <translation>%1, Zustand %2, %3 %4, Spindel %5°, z %6 mm</translation>
    </message>
    <message>
        <source>Decoding %1</source>
        <translation>%1 wird decodiert</translation>
    </message>
    <message>
        <source>This image cannot be shown</source>
        <translation>Dieses Bild lässt sich nicht darstellen</translation>
    </message>
    <message>
        <source>disturbed</source>
        <translation>gestört</translation>
    </message>
    <message>
        <source>Capture plan</source>
        <translation>Aufnahmeplan</translation>
    </message>
    <message>
        <source>Image with overlay</source>
        <translation>Bild mit Überlagerung</translation>
    </message>
    <message numerus="yes">
        <source>%n captures are there and none is checked yet. Checking decodes every image and says which to take again.</source>
        <translation>
            <numerusform>%n Aufnahme ist vorhanden und noch nicht geprüft. Die Prüfung decodiert jedes Bild und sagt, welche zu wiederholen ist.</numerusform>
            <numerusform>%n Aufnahmen sind vorhanden, noch keine ist geprüft. Die Prüfung decodiert jedes Bild und sagt, welche zu wiederholen sind.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All %n captures are checked and can be used.</source>
        <translation>
            <numerusform>Die einzige Aufnahme ist geprüft und verwendbar.</numerusform>
            <numerusform>Alle %n Aufnahmen sind geprüft und verwendbar.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n are</source>
        <translation>
            <numerusform>eine ist</numerusform>
            <numerusform>%n sind</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Of %n captures %1 can be used, %2 excluded.</source>
        <translation>
            <numerusform>Von %n Aufnahme ist %1 brauchbar, %2 ausgeschlossen.</numerusform>
            <numerusform>Von %n Aufnahmen sind %1 brauchbar, %2 ausgeschlossen.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n of %1 captures failed the check (%2). Take them again, or exclude them: what decodes of them is evaluated as it is.</source>
        <translation>
            <numerusform>%n von %1 Aufnahmen hat die Prüfung nicht bestanden (%2). Wiederholen oder ausschließen: was sich davon dekodieren lässt, wird ausgewertet, wie es ist.</numerusform>
            <numerusform>%n von %1 Aufnahmen haben die Prüfung nicht bestanden (%2). Wiederholen oder ausschließen: was sich davon dekodieren lässt, wird ausgewertet, wie es ist.</numerusform>
        </translation>
    </message>
    <message>
        <source>Leave what is chosen in the list out of the evaluation; it stays on the disk and can be brought back</source>
        <translation>Lässt das in der Liste Gewählte bei der Auswertung aus; es bleibt auf der Platte und kann zurückgeholt werden</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::FieldsDialog</name>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Take over</source>
        <translation>Übernehmen</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::GapBars</name>
    <message>
        <source>%1 → %2</source>
        <translation>%1 → %2</translation>
    </message>
    <message>
        <source>fit %1 %</source>
        <translation>Fit %1 %</translation>
    </message>
    <message>
        <source>rms before, after and noise floor</source>
        <translation>rms vorher, nachher und Grundrauschen</translation>
    </message>
    <message>
        <source>before</source>
        <translation>vorher</translation>
    </message>
    <message>
        <source>after</source>
        <translation>nachher</translation>
    </message>
    <message>
        <source>Fitted observations, rms</source>
        <translation>Angepasste Beobachtungen, rms</translation>
    </message>
    <message>
        <source>Held-out observations, rms</source>
        <translation>Validierungsdaten, rms</translation>
    </message>
    <message>
        <source>Blocks left out in turn, rms</source>
        <translation>Reihum ausgelassene Blöcke, rms</translation>
    </message>
    <message>
        <source>noise floor %1</source>
        <translation>Grundrauschen %1</translation>
    </message>
    <message>
        <source>p2p %1 %2</source>
        <translation>p2p %1 %2</translation>
    </message>
    <message>
        <source>rms: of the residuals of all observations. p2p: the largest peak-to-peak of the residual of one series. fit: 100 % is perfect, 0 % no better than a constant for each series.</source>
        <translation>rms: der Residuen aller Beobachtungen. p2p: größter Spitze-Spitze-Wert des Residuums einer Reihe. Fit: 100 % ist perfekt, 0 % nicht besser als eine Konstante je Reihe.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::GapPanel</name>
    <message>
        <source>How large the gap is</source>
        <translation>Wie groß die Differenz ist</translation>
    </message>
    <message>
        <source>Component shown</source>
        <translation>Gezeigte Komponente</translation>
    </message>
    <message>
        <source>Point shown over time</source>
        <translation>Über der Zeit gezeigter Punkt</translation>
    </message>
    <message>
        <source>Over time</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>On the machine</source>
        <translation>An der Maschine</translation>
    </message>
    <message>
        <source>What is compared</source>
        <translation>Was verglichen wird</translation>
    </message>
    <message>
        <source>Moment shown on the machine</source>
        <translation>An der Maschine gezeigter Zeitpunkt</translation>
    </message>
    <message>
        <source>Moment shown on the machine; the arrow keys go from one state to the next</source>
        <translation>An der Maschine gezeigter Zeitpunkt; die Pfeiltasten gehen von Zustand zu Zustand</translation>
    </message>
    <message>
        <source>After, over time</source>
        <translation>Nachher, über der Zeit</translation>
    </message>
    <message>
        <source>Before, over time</source>
        <translation>Vorher, über der Zeit</translation>
    </message>
    <message>
        <source>After, on the machine</source>
        <translation>Nachher, an der Maschine</translation>
    </message>
    <message>
        <source>Before, on the machine</source>
        <translation>Vorher, an der Maschine</translation>
    </message>
    <message>
        <source>Click a value: the machine is shown at its time</source>
        <translation>Wert anklicken: die Maschine wird zu diesem Zeitpunkt gezeigt</translation>
    </message>
    <message>
        <source>Measured and simulated</source>
        <translation>Gemessen und simuliert</translation>
    </message>
    <message>
        <source>Search to compare them over time.</source>
        <translation>Suchen, um sie über der Zeit zu vergleichen.</translation>
    </message>
    <message>
        <source>Nothing has been added yet</source>
        <translation>Noch wurde nichts hinzugefügt</translation>
    </message>
    <message>
        <source>Press Add to the model: the fit with the effect appears here.</source>
        <translation>„Zum Modell hinzufügen“ drücken: hier erscheint die Anpassung mit dem Effekt.</translation>
    </message>
    <message>
        <source>Measured minus simulated</source>
        <translation>Gemessen minus simuliert</translation>
    </message>
    <message>
        <source>Search to see it on the machine.</source>
        <translation>Suchen, um es an der Maschine zu sehen.</translation>
    </message>
    <message>
        <source>Press Add to the model: what remains at each point appears here.</source>
        <translation>„Zum Modell hinzufügen“ drücken: hier erscheint, was an jedem Punkt verbleibt.</translation>
    </message>
    <message>
        <source>Nothing has been added yet. With what is proposed the rms would fall to %1.</source>
        <translation>Noch wurde nichts hinzugefügt. Mit dem Vorschlag würde der rms auf %1 sinken.</translation>
    </message>
    <message>
        <source>Nothing has been added to the simulation.</source>
        <translation>Zur Simulation wurde nichts hinzugefügt.</translation>
    </message>
    <message>
        <source>After: simulation plus %1, fitted jointly.</source>
        <translation>Nachher: Simulation plus %1, gemeinsam angepasst.</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>Press Add to the model: what then remains appears here.</source>
        <translation>„Zum Modell hinzufügen“ drücken: hier erscheint, was dann verbleibt.</translation>
    </message>
    <message>
        <source>The search proposes no effect to add.</source>
        <translation>Die Suche schlägt keinen Effekt vor.</translation>
    </message>
    <message>
        <source>Points: measured. Line: model with the free constant of the series, ± 2 σ of the noise.</source>
        <translation>Punkte: gemessen. Linie: Modell mit der freien Konstante der Reihe, ± 2 σ des Rauschens.</translation>
    </message>
    <message>
        <source>Noise scale of %1: %2 times the stated σ</source>
        <translation>Rauschfaktor von %1: %2-mal das angegebene σ</translation>
    </message>
    <message>
        <source>, common shift %1</source>
        <translation>, gemeinsame Verschiebung %1</translation>
    </message>
    <message>
        <source>, %1 % of it correlated over %2</source>
        <translation>, davon %1 % korreliert über %2</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>simulated</source>
        <translation>simuliert</translation>
    </message>
    <message>
        <source>simulated + added</source>
        <translation>simuliert + hinzugefügt</translation>
    </message>
    <message>
        <source>held out</source>
        <translation>Validierungsdaten</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>Before: %1 of %2, rms %3</source>
        <translation>Vorher: %1 von %2, rms %3</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Nachher</translation>
    </message>
    <message>
        <source>After: %1 of %2, rms %3</source>
        <translation>Nachher: %1 von %2, rms %3</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>On the machine at %1</source>
        <translation>An der Maschine bei %1</translation>
    </message>
    <message>
        <source>%1, measured − model at %2</source>
        <translation>%1, gemessen − Modell bei %2</translation>
    </message>
    <message>
        <source>%1 ± %2 %3</source>
        <translation>%1 ± %2 %3</translation>
    </message>
    <message>
        <source>Gap rms</source>
        <translation>Differenz, rms</translation>
    </message>
    <message>
        <source>Before %1</source>
        <translation>Vorher %1</translation>
    </message>
    <message>
        <source>After %1</source>
        <translation>Nachher %1</translation>
    </message>
    <message>
        <source>Before on the machine %1</source>
        <translation>Vorher an der Maschine %1</translation>
    </message>
    <message>
        <source>After on the machine %1</source>
        <translation>Nachher an der Maschine %1</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::HelpPanel</name>
    <message>
        <source>Help on this step</source>
        <translation>Hilfe zu diesem Schritt</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Close the help (F1)</source>
        <translation>Hilfe schließen (F1)</translation>
    </message>
    <message>
        <source>Close the help</source>
        <translation>Hilfe schließen</translation>
    </message>
    <message>
        <source>Help text</source>
        <translation>Hilfetext</translation>
    </message>
    <message>
        <source>Effects of the catalogue</source>
        <translation>Effekte des Katalogs</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::HistoryCard</name>
    <message>
        <source>The last hour</source>
        <translation>Die letzte Stunde</translation>
    </message>
    <message>
        <source>Values will appear here as they come</source>
        <translation>Hier erscheinen die eingehenden Werte</translation>
    </message>
    <message>
        <source>Press Live view or Record.</source>
        <translation>„Live-Ansicht“ oder „Aufzeichnen“ drücken.</translation>
    </message>
    <message>
        <source>Temperature / °C</source>
        <translation>Temperatur / °C</translation>
    </message>
    <message>
        <source>The last hour: %1</source>
        <translation>Die letzte Stunde: %1</translation>
    </message>
    <message>
        <source>Time from now / %1</source>
        <translation>Zeit ab jetzt / %1</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ImageView</name>
    <message>
        <source>Image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>x %1 px, y %2 px: grey level %3</source>
        <translation>x %1 px, y %2 px: Grauwert %3</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::IncomingService</name>
    <message>
        <source>Open a session or a new measurement first.</source>
        <translation>Zuerst eine Sitzung oder eine neue Messung öffnen.</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is not a folder; allowed: the folder into which the instrument writes.</source>
        <translation>„%1“ ist kein Ordner; zulässig: der Ordner, in den das Messgerät schreibt.</translation>
    </message>
    <message>
        <source>This folder belongs to the session itself; allowed: the folder into which the instrument writes.</source>
        <translation>Dieser Ordner gehört zur Sitzung selbst; zulässig: der Ordner, in den das Messgerät schreibt.</translation>
    </message>
    <message>
        <source>Take %1 again: %2</source>
        <translation>%1 wiederholen: %2</translation>
    </message>
    <message>
        <source>Checking %1</source>
        <translation>%1 wird geprüft</translation>
    </message>
    <message>
        <source>%1 is there already; this one is kept aside.</source>
        <translation>%1 ist schon vorhanden; diese Datei wird beiseitegelegt.</translation>
    </message>
    <message>
        <source>Checking the picture</source>
        <translation>Das Bild wird geprüft</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::IsoPanel</name>
    <message>
        <source>Environment (ETVE)</source>
        <translation>Umgebung (ETVE)</translation>
    </message>
    <message>
        <source>Rotating spindle</source>
        <translation>Drehende Spindel</translation>
    </message>
    <message>
        <source>Test of ISO 230-3</source>
        <translation>Prüfung nach ISO 230-3</translation>
    </message>
    <message>
        <source>Ambient</source>
        <translation>Umgebung</translation>
    </message>
    <message>
        <source>Ambient temperature</source>
        <translation>Umgebungstemperatur</translation>
    </message>
    <message>
        <source>From:to / s</source>
        <translation>Von:bis / s</translation>
    </message>
    <message>
        <source>Seconds of the record that are the test, from:to</source>
        <translation>Sekunden der Aufzeichnung, die zur Prüfung gehören, von:bis</translation>
    </message>
    <message>
        <source>whole record</source>
        <translation>gesamte Aufzeichnung</translation>
    </message>
    <message>
        <source>Component</source>
        <translation>Komponente</translation>
    </message>
    <message>
        <source>Over the test</source>
        <translation>Über die Prüfung</translation>
    </message>
    <message>
        <source>Slope, or time</source>
        <translation>Steigung oder Zeit</translation>
    </message>
    <message>
        <source>Time / h</source>
        <translation>Zeit / h</translation>
    </message>
    <message>
        <source>The test will appear here</source>
        <translation>Hier erscheint die Prüfung</translation>
    </message>
    <message>
        <source>It needs displacements over time.</source>
        <translation>Sie braucht Verschiebungen über der Zeit.</translation>
    </message>
    <message>
        <source>Parameters of ISO 230-3</source>
        <translation>Kenngrößen nach ISO 230-3</translation>
    </message>
    <message>
        <source>Range, change and time of each component appear here.</source>
        <translation>Hier erscheinen Spanne, Änderung und Zeit jeder Komponente.</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>range %1</source>
        <translation>Spanne %1</translation>
    </message>
    <message>
        <source>%1 %2/K</source>
        <translation>%1 %2/K</translation>
    </message>
    <message>
        <source>slope %1</source>
        <translation>Steigung %1</translation>
    </message>
    <message>
        <source>Over %1 h, ambient temperature within %2 K.</source>
        <translation>Über %1 h, Umgebungstemperatur innerhalb %2 K.</translation>
    </message>
    <message>
        <source>at the end %1</source>
        <translation>am Ende %1</translation>
    </message>
    <message>
        <source>first hour %1</source>
        <translation>erste Stunde %1</translation>
    </message>
    <message>
        <source>%1 % after %2 min</source>
        <translation>%1 % nach %2 min</translation>
    </message>
    <message>
        <source>The spindle ran from %1 h to %2 h.</source>
        <translation>Die Spindel lief von %1 h bis %2 h.</translation>
    </message>
    <message>
        <source>Per degree, or first hour</source>
        <translation>Je Grad oder erste Stunde</translation>
    </message>
    <message>
        <source>Displacement / µm</source>
        <translation>Verschiebung / µm</translation>
    </message>
    <message>
        <source>Rotation / µrad</source>
        <translation>Drehung / µrad</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ItemsCard</name>
    <message>
        <source>What is there</source>
        <translation>Angebot</translation>
    </message>
    <message>
        <source>Shows the data items that have this in their names. What cannot be listed (a register, a topic, a place in a line) is added by its address.</source>
        <translation>Zeigt die Datenpunkte, deren Name dies enthält. Was sich nicht auflisten lässt (Register, Topic, Stelle in einer Zeile), wird über seine Adresse hinzugefügt.</translation>
    </message>
    <message>
        <source>Filter the data items, or address of one</source>
        <translation>Datenpunkte filtern oder Adresse eines Datenpunkts</translation>
    </message>
    <message>
        <source>Add the data item with this address</source>
        <translation>Datenpunkt mit dieser Adresse hinzufügen</translation>
    </message>
    <message>
        <source>Add a data item by its address</source>
        <translation>Datenpunkt über seine Adresse hinzufügen</translation>
    </message>
    <message>
        <source>Data item</source>
        <translation>Datenpunkt</translation>
    </message>
    <message>
        <source>Now</source>
        <translation>Jetzt</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>Data items of the source</source>
        <translation>Datenpunkte der Quelle</translation>
    </message>
    <message>
        <source>Data items of the source appear here; tick those that are to be recorded.</source>
        <translation>Hier erscheinen die Datenpunkte der Quelle; ankreuzen, was aufgezeichnet werden soll.</translation>
    </message>
    <message>
        <source>Filter</source>
        <translation>Filter</translation>
    </message>
    <message>
        <source>Type the address of the data item beside this button first.</source>
        <translation>Zuerst neben dieser Schaltfläche die Adresse des Datenpunkts eingeben.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::JobBar</name>
    <message>
        <source>Ready</source>
        <translation>Bereit</translation>
    </message>
    <message>
        <source>Progress</source>
        <translation>Fortschritt</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Stop what is running; nothing of it is applied</source>
        <translation>Laufendes anhalten; nichts davon wird übernommen</translation>
    </message>
    <message>
        <source>Messages</source>
        <translation>Meldungen</translation>
    </message>
    <message>
        <source>Jobs that run and wait, and all messages so far</source>
        <translation>Laufende und wartende Aufträge und alle bisherigen Meldungen</translation>
    </message>
    <message numerus="yes">
        <source>%n waiting</source>
        <translation>
            <numerusform>%n wartet</numerusform>
            <numerusform>%n warten</numerusform>
        </translation>
    </message>
    <message>
        <source>Stopping …</source>
        <translation>Wird angehalten …</translation>
    </message>
    <message>
        <source>%1: done</source>
        <translation>%1: fertig</translation>
    </message>
    <message>
        <source>%1: cancelled, nothing was changed</source>
        <translation>%1: abgebrochen, nichts wurde geändert</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::LiveCompensationPanel</name>
    <message>
        <source>Predicted now</source>
        <translation>Jetzt vorhergesagt</translation>
    </message>
    <message>
        <source>Measured now</source>
        <translation>Jetzt gemessen</translation>
    </message>
    <message>
        <source>Measured minus predicted, rms</source>
        <translation>Gemessen minus vorhergesagt, rms</translation>
    </message>
    <message>
        <source>Prediction and measurement will appear here as data come</source>
        <translation>Hier erscheinen Vorhersage und Messung, sobald Daten eingehen</translation>
    </message>
    <message>
        <source>Connect the columns of the model (Machine, Connections), and look at them live.</source>
        <translation>Spalten des Modells verbinden (Maschine, Verbindungen) und live ansehen.</translation>
    </message>
    <message>
        <source>There is no model over time yet: identify one (Model).</source>
        <translation>Es gibt noch kein Modell über der Zeit: eines identifizieren (Modell).</translation>
    </message>
    <message>
        <source>Nothing is connected at present: look at the columns live, or record them (Machine, Connections).</source>
        <translation>Zurzeit ist nichts verbunden: Spalten live ansehen oder aufzeichnen (Maschine, Verbindungen).</translation>
    </message>
    <message>
        <source>The model needs columns that are not connected: %1.</source>
        <translation>Das Modell braucht Spalten, die nicht verbunden sind: %1.</translation>
    </message>
    <message>
        <source>Waiting for a first value of every column that the model needs.</source>
        <translation>Wartet auf einen ersten Wert jeder Spalte, die das Modell braucht.</translation>
    </message>
    <message>
        <source>Fall-back: %1 has been bad for too long; a control would fade its correction out.</source>
        <translation>Rückfallbetrieb: %1 ist zu lange schlecht; eine Steuerung würde ihre Korrektur abklingen lassen.</translation>
    </message>
    <message>
        <source>%1 is bad at present; its last good value is used.</source>
        <translation>%1 ist zurzeit schlecht; verwendet wird der letzte gute Wert.</translation>
    </message>
    <message>
        <source>The model was called not good enough when it was identified: look, and do not compensate with it.</source>
        <translation>Das Modell wurde bei der Identifikation als nicht gut genug beurteilt: nur ansehen, nicht damit kompensieren.</translation>
    </message>
    <message>
        <source>The compensator runs as it would in the control; nothing is sent to the machine.</source>
        <translation>Der Kompensator läuft wie in der Steuerung; an die Maschine wird nichts gesendet.</translation>
    </message>
    <message>
        <source>%1; the correction is minus this</source>
        <translation>%1; die Korrektur ist das Negative davon</translation>
    </message>
    <message>
        <source>%1 is not connected</source>
        <translation>%1 ist nicht verbunden</translation>
    </message>
    <message>
        <source>about its mean, since %1 min</source>
        <translation>bezogen auf den Mittelwert, seit %1 min</translation>
    </message>
    <message>
        <source>predicted</source>
        <translation>vorhergesagt</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>Time from now / %1</source>
        <translation>Zeit ab jetzt / %1</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::LiveTouchPanel</name>
    <message>
        <source>No touch has come in yet.</source>
        <translation>Noch ist keine Antastung eingegangen.</translation>
    </message>
    <message>
        <source>Progress in the cycle</source>
        <translation>Fortschritt im Zyklus</translation>
    </message>
    <message>
        <source>Touch</source>
        <translation>Antastung</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Off place
/ mm</source>
        <translation>Lageabw.
/ mm</translation>
    </message>
    <message>
        <source>Change
/ µm</source>
        <translation>Änderung
/ µm</translation>
    </message>
    <message>
        <source>Spread
/ µm</source>
        <translation>Streuung
/ µm</translation>
    </message>
    <message>
        <source>Approach</source>
        <translation>Anfahrt</translation>
    </message>
    <message>
        <source>Why</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>Touches as they come in</source>
        <translation>Antastungen beim Eintreffen</translation>
    </message>
    <message>
        <source>Touches appear here while the control writes its list or prints its text.</source>
        <translation>Hier erscheinen Antastungen, während die Steuerung ihre Liste schreibt oder ihren Text druckt.</translation>
    </message>
    <message>
        <source>replaced</source>
        <translation>ersetzt</translation>
    </message>
    <message>
        <source>plausible</source>
        <translation>plausibel</translation>
    </message>
    <message>
        <source>touch again</source>
        <translation>erneut antasten</translation>
    </message>
    <message>
        <source>Cycle %1: %2 with %3</source>
        <translation>Zyklus %1: %2 mit %3</translation>
    </message>
    <message>
        <source> at %1°</source>
        <translation> bei %1°</translation>
    </message>
    <message>
        <source>, %1 of %2 touches</source>
        <translation>, %1 von %2 Antastungen</translation>
    </message>
    <message>
        <source>; next %1</source>
        <translation>; als Nächstes %1</translation>
    </message>
    <message>
        <source> (a line is half written)</source>
        <translation> (eine Zeile ist halb geschrieben)</translation>
    </message>
    <message numerus="yes">
        <source>, %n touches</source>
        <translation>
            <numerusform>, %n Antastung</numerusform>
            <numerusform>, %n Antastungen</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::LogCompensatePage</name>
    <message>
        <source>Run the compensator that the control would run over the log, and export its model.</source>
        <translation>Den Kompensator, den die Steuerung ausführen würde, über das Protokoll laufen lassen und sein Modell exportieren.</translation>
    </message>
    <message>
        <source>Live …</source>
        <translation>Live …</translation>
    </message>
    <message>
        <source>Measure, model and compensate at the control, while the machine works</source>
        <translation>An der Steuerung messen, modellieren und kompensieren, während die Maschine arbeitet</translation>
    </message>
    <message>
        <source>Run the compensator</source>
        <translation>Kompensator ausführen</translation>
    </message>
    <message>
        <source>Measured in the test range, rms</source>
        <translation>Im Prüfbereich gemessen, rms</translation>
    </message>
    <message>
        <source>With the compensator, rms</source>
        <translation>Mit dem Kompensator, rms</translation>
    </message>
    <message>
        <source>Largest correction</source>
        <translation>Größte Korrektur</translation>
    </message>
    <message>
        <source>Measured deviation, correction and residual will appear here</source>
        <translation>Hier erscheinen gemessene Abweichung, Korrektur und Residuum</translation>
    </message>
    <message>
        <source>Identify a model (Model), then press Run the compensator.</source>
        <translation>Ein Modell identifizieren (Modell), dann „Kompensator ausführen“ drücken.</translation>
    </message>
    <message>
        <source>Over the log</source>
        <translation>Über das Protokoll</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>Livebild</translation>
    </message>
    <message>
        <source>Reading the compensation</source>
        <translation>Die Kompensation wird gelesen</translation>
    </message>
    <message>
        <source>In the test range %1 %3 rms remain of %2 %3. Export the thermal model for the control.</source>
        <translation>Im Prüfbereich verbleiben %1 %3 rms von %2 %3. Das thermische Modell für die Steuerung exportieren.</translation>
    </message>
    <message>
        <source>rms in the test range: %1 %3 with, %2 %3 without compensation: no improvement. Train on a longer range with more excitation (Model).</source>
        <translation>rms im Prüfbereich: %1 %3 mit, %2 %3 ohne Kompensation: keine Verbesserung. An einem längeren Bereich mit mehr Anregung trainieren (Modell).</translation>
    </message>
    <message>
        <source>%1, about its mean</source>
        <translation>%1, bezogen auf den Mittelwert</translation>
    </message>
    <message>
        <source>about its mean, test range</source>
        <translation>bezogen auf den Mittelwert, Prüfbereich</translation>
    </message>
    <message>
        <source>%1 of %2 cycles in fall-back</source>
        <translation>%1 von %2 Zyklen im Rückfallbetrieb</translation>
    </message>
    <message>
        <source>added to the command, cycle %1 s</source>
        <translation>zum Sollwert addiert, Zyklus %1 s</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>correction</source>
        <translation>Korrektur</translation>
    </message>
    <message>
        <source>left</source>
        <translation>Rest</translation>
    </message>
    <message>
        <source>test</source>
        <translation>Prüfung</translation>
    </message>
    <message>
        <source>Prediction and measurement, live</source>
        <translation>Vorhersage und Messung, live</translation>
    </message>
    <message>
        <source>Thermal model</source>
        <translation>Thermisches Modell</translation>
    </message>
    <message>
        <source>Corrections over time</source>
        <translation>Korrekturen über der Zeit</translation>
    </message>
    <message>
        <source>Compensator over the log</source>
        <translation>Kompensator über das Protokoll</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::MachinePage</name>
    <message>
        <source>%1 and %2</source>
        <translation>%1 und %2</translation>
    </message>
    <message>
        <source>No resolution is stated for %1: verdicts against the resolution are left out.</source>
        <translation>Für %1 ist keine Auflösung angegeben: Urteile gegen die Auflösung entfallen.</translation>
    </message>
    <message>
        <source>No fixed bearing is stated for the %1 ball screw: its expansion has no reference.</source>
        <translation>Für den Kugelgewindetrieb %1 ist kein Festlager angegeben: seine Ausdehnung hat keinen Bezugspunkt.</translation>
    </message>
    <message>
        <source>Point %1 lies outside the travel of axis %2 (%3 mm; travel %4 to %5 mm).</source>
        <translation>Punkt %1 liegt außerhalb des Verfahrwegs der Achse %2 (%3 mm; Verfahrweg %4 bis %5 mm).</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Verwerfen</translation>
    </message>
    <message>
        <source>Apply changes</source>
        <translation>Änderungen übernehmen</translation>
    </message>
    <message>
        <source>Back to machine.json</source>
        <translation>Zurück zu machine.json</translation>
    </message>
    <message>
        <source>Name of the machine</source>
        <translation>Name der Maschine</translation>
    </message>
    <message>
        <source>Kinematic chain</source>
        <translation>Kinematische Kette</translation>
    </message>
    <message>
        <source>From the workpiece w over the bed b to the tool t (ISO 10791-1); &apos; marks an axis that carries the workpiece</source>
        <translation>Vom Werkstück w über das Bett b zum Werkzeug t (ISO 10791-1); &apos; kennzeichnet eine Achse, die das Werkstück trägt</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Chain</source>
        <translation>Kette</translation>
    </message>
    <message>
        <source>Linear axes</source>
        <translation>Linearachsen</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>From
/ mm</source>
        <translation>Von
/ mm</translation>
    </message>
    <message>
        <source>To
/ mm</source>
        <translation>Bis
/ mm</translation>
    </message>
    <message>
        <source>Resolution
/ µm</source>
        <translation>Auflösung
/ µm</translation>
    </message>
    <message>
        <source>Drive</source>
        <translation>Antrieb</translation>
    </message>
    <message>
        <source>Pitch
/ mm</source>
        <translation>Steigung
/ mm</translation>
    </message>
    <message>
        <source>Fixed bearing
/ mm</source>
        <translation>Festlager
/ mm</translation>
    </message>
    <message>
        <source>Measuring points</source>
        <translation>Messpunkte</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>x / mm</source>
        <translation>x / mm</translation>
    </message>
    <message>
        <source>y / mm</source>
        <translation>y / mm</translation>
    </message>
    <message>
        <source>z / mm</source>
        <translation>z / mm</translation>
    </message>
    <message>
        <source>Add point</source>
        <translation>Punkt hinzufügen</translation>
    </message>
    <message>
        <source>Remove point</source>
        <translation>Punkt entfernen</translation>
    </message>
    <message>
        <source>How many points to suggest</source>
        <translation>Anzahl der vorzuschlagenden Punkte</translation>
    </message>
    <message>
        <source>best heat map</source>
        <translation>beste Farbkarte</translation>
    </message>
    <message>
        <source>best parameters</source>
        <translation>beste Parameter</translation>
    </message>
    <message>
        <source>What the points shall be best for</source>
        <translation>Wofür die Punkte am besten sein sollen</translation>
    </message>
    <message>
        <source>Suggest points</source>
        <translation>Punkte vorschlagen</translation>
    </message>
    <message>
        <source>Chooses, from a lattice over the table, where so many fiducials determine the nine parameters best: smallest mean variance of the heat map (I-optimal) or smallest confidence region of the parameters (D-optimal)</source>
        <translation>Wählt aus einem Raster über dem Tisch die Stellen, an denen so viele Messmarken die neun Parameter am besten bestimmen: kleinste mittlere Varianz der Farbkarte (I-optimal) oder kleinster Konfidenzbereich der Parameter (D-optimal)</translation>
    </message>
    <message>
        <source>How it is built</source>
        <translation>Aufbau</translation>
    </message>
    <message>
        <source>The machine will appear here</source>
        <translation>Hier erscheint die Maschine</translation>
    </message>
    <message>
        <source>Give its chain and the travel of its axes.</source>
        <translation>Ihre Kette und die Verfahrwege ihrer Achsen angeben.</translation>
    </message>
    <message>
        <source>Axes and points</source>
        <translation>Achsen und Punkte</translation>
    </message>
    <message>
        <source>Artefacts and styli</source>
        <translation>Prüfkörper und Tastereinsätze</translation>
    </message>
    <message>
        <source>Temperature sensors</source>
        <translation>Temperatursensoren</translation>
    </message>
    <message>
        <source>Connections</source>
        <translation>Verbindungen</translation>
    </message>
    <message>
        <source>What was typed here is not applied yet: apply the changes, or discard them.</source>
        <translation>Die Eingaben sind noch nicht übernommen: Änderungen übernehmen oder verwerfen.</translation>
    </message>
    <message>
        <source>Where a sensor sits decides which effects it can drive. What was read from the name of its column is to be confirmed or put right.</source>
        <translation>Der Ort eines Sensors entscheidet, welche Effekte er antreiben kann. Was aus dem Namen der Spalte geschlossen wurde, ist zu bestätigen oder zu berichtigen.</translation>
    </message>
    <message>
        <source>Column of the log</source>
        <translation>Spalte des Protokolls</translation>
    </message>
    <message>
        <source>Place</source>
        <translation>Ort</translation>
    </message>
    <message>
        <source>Role</source>
        <translation>Rolle</translation>
    </message>
    <message>
        <source>Known from</source>
        <translation>Bekannt aus</translation>
    </message>
    <message>
        <source>Confirm all</source>
        <translation>Alle bestätigen</translation>
    </message>
    <message>
        <source>Role of %1</source>
        <translation>Rolle von %1</translation>
    </message>
    <message>
        <source>machine.json</source>
        <translation>machine.json</translation>
    </message>
    <message>
        <source>its name: please confirm</source>
        <translation>ihrem Namen: bitte bestätigen</translation>
    </message>
    <message>
        <source>this page</source>
        <translation>dieser Seite</translation>
    </message>
    <message>
        <source>The description is complete for everything Spindrift does with it.</source>
        <translation>Die Beschreibung ist vollständig für alles, was Spindrift damit tut.</translation>
    </message>
    <message>
        <source> And %1 more.</source>
        <translation> Und %1 weitere.</translation>
    </message>
    <message>
        <source>Choosing measuring points</source>
        <translation>Messpunkte werden gewählt</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Machine description</source>
        <translation>Maschinenbeschreibung</translation>
    </message>
    <message numerus="yes">
        <source>%n points added below. With them the heat map would be uncertain by %1 µm on average and %2 µm at worst (0.5 µm in X and Y, 1 µm in Z per fiducial). Apply the changes, or discard them.</source>
        <translation>
            <numerusform>%n Punkt unten hinzugefügt. Mit ihm wäre die Farbkarte im Mittel auf %1 µm und schlimmstenfalls auf %2 µm unsicher (0,5 µm in X und Y, 1 µm in Z je Messmarke). Die Änderungen übernehmen oder verwerfen.</numerusform>
            <numerusform>%n Punkte unten hinzugefügt. Mit ihnen wäre die Farbkarte im Mittel auf %1 µm und schlimmstenfalls auf %2 µm unsicher (0,5 µm in X und Y, 1 µm in Z je Messmarke). Die Änderungen übernehmen oder verwerfen.</numerusform>
        </translation>
    </message>
    <message>
        <source>add a point</source>
        <translation>Punkt hinzufügen</translation>
    </message>
    <message>
        <source>remove a point</source>
        <translation>Punkt entfernen</translation>
    </message>
    <message>
        <source>Something was typed here for another state of the machine. Show it, or discard it.</source>
        <translation>Hier wurde etwas für einen anderen Stand der Maschine eingegeben. Anzeigen oder verwerfen.</translation>
    </message>
    <message>
        <source>Show it</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>confirm the roles of the sensors</source>
        <translation>Rollen der Sensoren bestätigen</translation>
    </message>
    <message>
        <source>change the description</source>
        <translation>Beschreibung ändern</translation>
    </message>
    <message>
        <source>suggest points</source>
        <translation>Punkte vorschlagen</translation>
    </message>
    <message>
        <source>The machine was changed meanwhile. Suggest the points again.</source>
        <translation>Die Maschine wurde inzwischen geändert. Die Punkte erneut vorschlagen lassen.</translation>
    </message>
    <message>
        <source>ball screw</source>
        <translation>Kugelgewindetrieb</translation>
    </message>
    <message>
        <source>rotary encoder</source>
        <translation>Drehgeber</translation>
    </message>
    <message>
        <source>linear scale</source>
        <translation>Linearmaßstab</translation>
    </message>
    <message>
        <source>fiducial</source>
        <translation>Messmarke</translation>
    </message>
    <message>
        <source>hole</source>
        <translation>Loch</translation>
    </message>
    <message>
        <source>ball</source>
        <translation>Kugel</translation>
    </message>
    <message>
        <source>surface</source>
        <translation>Fläche</translation>
    </message>
    <message>
        <source>No measuring point yet.</source>
        <translation>Noch kein Messpunkt.</translation>
    </message>
    <message>
        <source>Position from</source>
        <translation>Wegmessung</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::MachineStateLine</name>
    <message>
        <source>The machine stands still: %1.</source>
        <translation>Die Maschine steht still: %1.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::MainWindow</name>
    <message>
        <source>Campaign</source>
        <translation>Kampagne</translation>
    </message>
    <message>
        <source>The campaign at hand; a session may hold several</source>
        <translation>Aktuelle Kampagne; eine Sitzung kann mehrere enthalten</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Weiter</translation>
    </message>
    <message>
        <source>Open a session</source>
        <translation>Sitzung öffnen</translation>
    </message>
    <message>
        <source>Open a campaign folder</source>
        <translation>Kampagnenordner öffnen</translation>
    </message>
    <message>
        <source>%1 – Spindrift</source>
        <translation>%1 – Spindrift</translation>
    </message>
    <message>
        <source>Session %1</source>
        <translation>Sitzung %1</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>%1 wird geöffnet</translation>
    </message>
    <message>
        <source>Checking files for changes</source>
        <translation>Dateien werden auf Änderungen geprüft</translation>
    </message>
    <message>
        <source>Files of the campaign %1 have changed since its results were calculated: %2.</source>
        <translation>Dateien der Kampagne %1 haben sich geändert, seit ihre Ergebnisse berechnet wurden: %2.</translation>
    </message>
    <message>
        <source>Not written</source>
        <translation>Nicht geschrieben</translation>
    </message>
    <message>
        <source>%1 lost</source>
        <translation>%1 ausgefallen</translation>
    </message>
    <message>
        <source>%1 sources lost</source>
        <translation>%1 Quellen ausgefallen</translation>
    </message>
    <message>
        <source>Compensating</source>
        <translation>Kompensiert</translation>
    </message>
    <message>
        <source>Compensation off</source>
        <translation>Kompensation aus</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufzeichnung</translation>
    </message>
    <message>
        <source>Live</source>
        <translation>Livebild</translation>
    </message>
    <message>
        <source>Connected; nothing is written</source>
        <translation>Verbunden; es wird nichts geschrieben</translation>
    </message>
    <message>
        <source>Importing %1</source>
        <translation>%1 wird importiert</translation>
    </message>
    <message>
        <source>Open a session first; a campaign is added to it.</source>
        <translation>Zuerst eine Sitzung öffnen; ihr wird eine Kampagne hinzugefügt.</translation>
    </message>
    <message>
        <source>Adding %1</source>
        <translation>%1 wird hinzugefügt</translation>
    </message>
    <message>
        <source>Running the virtual machine: %1</source>
        <translation>Die virtuelle Maschine läuft: %1</translation>
    </message>
    <message>
        <source>Open a session first; then its pictures and tables can be exported.</source>
        <translation>Zuerst eine Sitzung öffnen; dann lassen sich ihre Bilder und Tabellen exportieren.</translation>
    </message>
    <message>
        <source>This page has nothing to export yet.</source>
        <translation>Diese Seite hat noch nichts zu exportieren.</translation>
    </message>
    <message>
        <source>&amp;Session</source>
        <translation>&amp;Sitzung</translation>
    </message>
    <message>
        <source>&amp;New measurement …</source>
        <translation>&amp;Neue Messung …</translation>
    </message>
    <message>
        <source>&amp;Open session …</source>
        <translation>Sitzung &amp;öffnen …</translation>
    </message>
    <message>
        <source>Open &amp;campaign folder …</source>
        <translation>&amp;Kampagnenordner öffnen …</translation>
    </message>
    <message>
        <source>Ctrl+Shift+O</source>
        <translation>Ctrl+Shift+O</translation>
    </message>
    <message>
        <source>&amp;Add a campaign to this session …</source>
        <translation>Kampagne zu dieser Sitzung &amp;hinzufügen …</translation>
    </message>
    <message>
        <source>Ctrl+Shift+A</source>
        <translation>Ctrl+Shift+A</translation>
    </message>
    <message>
        <source>Choose the campaign folder to be added</source>
        <translation>Hinzuzufügenden Kampagnenordner wählen</translation>
    </message>
    <message>
        <source>Open &amp;log …</source>
        <translation>&amp;Protokoll öffnen …</translation>
    </message>
    <message>
        <source>Ctrl+L</source>
        <translation>Ctrl+L</translation>
    </message>
    <message>
        <source>Open a log over time</source>
        <translation>Protokoll über der Zeit öffnen</translation>
    </message>
    <message>
        <source>Log (*.csv)</source>
        <translation>Protokoll (*.csv)</translation>
    </message>
    <message>
        <source>&amp;Export …</source>
        <translation>&amp;Exportieren …</translation>
    </message>
    <message>
        <source>Ctrl+E</source>
        <translation>Ctrl+E</translation>
    </message>
    <message>
        <source>First &amp;screen</source>
        <translation>&amp;Startseite</translation>
    </message>
    <message>
        <source>Ctrl+H</source>
        <translation>Ctrl+H</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Beenden</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Bearbeiten</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Rückgängig</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Wiederholen</translation>
    </message>
    <message>
        <source>&amp;Notes …</source>
        <translation>&amp;Notizen …</translation>
    </message>
    <message>
        <source>Ctrl+M</source>
        <translation>Ctrl+M</translation>
    </message>
    <message>
        <source>&amp;Jobs and messages …</source>
        <translation>&amp;Aufträge und Meldungen …</translation>
    </message>
    <message>
        <source>Ctrl+J</source>
        <translation>Ctrl+J</translation>
    </message>
    <message>
        <source>&amp;Go</source>
        <translation>&amp;Gehe zu</translation>
    </message>
    <message>
        <source>&amp;Back</source>
        <translation>&amp;Zurück</translation>
    </message>
    <message>
        <source>Alt+Left</source>
        <translation>Alt+Left</translation>
    </message>
    <message>
        <source>&amp;Next</source>
        <translation>&amp;Weiter</translation>
    </message>
    <message>
        <source>Alt+Right</source>
        <translation>Alt+Right</translation>
    </message>
    <message>
        <source>&amp;Plant</source>
        <translation>We&amp;rk</translation>
    </message>
    <message>
        <source>Ctrl+Shift+P</source>
        <translation>Ctrl+Shift+P</translation>
    </message>
    <message>
        <source>&amp;Compensate: live</source>
        <translation>&amp;Kompensieren: live</translation>
    </message>
    <message>
        <source>Ctrl+Shift+L</source>
        <translation>Ctrl+Shift+L</translation>
    </message>
    <message>
        <source>Ctrl+Return</source>
        <translation>Ctrl+Return</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>&amp;Light or dark</source>
        <translation>&amp;Hell oder dunkel</translation>
    </message>
    <message>
        <source>Ctrl+D</source>
        <translation>Ctrl+D</translation>
    </message>
    <message>
        <source>&amp;Tools</source>
        <translation>&amp;Extras</translation>
    </message>
    <message>
        <source>&amp;Artefact designer …</source>
        <translation>&amp;Prüfkörper-Entwurf …</translation>
    </message>
    <message>
        <source>Ctrl+Shift+D</source>
        <translation>Ctrl+Shift+D</translation>
    </message>
    <message>
        <source>&amp;Effects of this machine …</source>
        <translation>&amp;Effekte dieser Maschine …</translation>
    </message>
    <message>
        <source>Ctrl+Shift+E</source>
        <translation>Ctrl+Shift+E</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>Help &amp;beside the step</source>
        <translation>Hilfe &amp;neben dem Schritt</translation>
    </message>
    <message>
        <source>&amp;Manual …</source>
        <translation>&amp;Handbuch …</translation>
    </message>
    <message>
        <source>The manual is not installed; &quot;spindrift-cli manual --out manual.pdf&quot; writes it.</source>
        <translation>Das Handbuch ist nicht installiert; „spindrift-cli manual --out manual.pdf“ schreibt es.</translation>
    </message>
    <message>
        <source>&amp;Copy diagnostics</source>
        <translation>&amp;Diagnose kopieren</translation>
    </message>
    <message>
        <source>Version, platform and the last messages are in the clipboard; folders and names are left out.</source>
        <translation>Version, Plattform und die letzten Meldungen sind in der Zwischenablage; Ordner und Namen sind ausgelassen.</translation>
    </message>
    <message>
        <source>&amp;Save the log …</source>
        <translation>&amp;Programmprotokoll speichern …</translation>
    </message>
    <message>
        <source>Save the log</source>
        <translation>Programmprotokoll speichern</translation>
    </message>
    <message>
        <source>Text (*.txt)</source>
        <translation>Text (*.txt)</translation>
    </message>
    <message>
        <source>&amp;About Spindrift</source>
        <translation>Über &amp;Spindrift</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>Undo: %1</source>
        <translation>Rückgängig: %1</translation>
    </message>
    <message>
        <source>Export pictures and tables of this page</source>
        <translation>Bilder und Tabellen dieser Seite exportieren</translation>
    </message>
    <message>
        <source>Light or dark</source>
        <translation>Hell oder dunkel</translation>
    </message>
    <message>
        <source>About Spindrift</source>
        <translation>Über Spindrift</translation>
    </message>
    <message>
        <source>&lt;h3&gt;Spindrift %1&lt;/h3&gt;&lt;p&gt;Thermal errors of machine tools: measure, understand, compensate.&lt;/p&gt;&lt;p&gt;GPL-3.0-or-later; the core library Apache-2.0.&lt;/p&gt;</source>
        <translation>&lt;h3&gt;Spindrift %1&lt;/h3&gt;&lt;p&gt;Thermische Abweichungen von Werkzeugmaschinen: messen, verstehen, kompensieren.&lt;/p&gt;&lt;p&gt;GPL-3.0-or-later; die Bibliothek core Apache-2.0.&lt;/p&gt;</translation>
    </message>
    <message>
        <source>The log was saved as %1. Folders and names are left out of it.</source>
        <translation>Das Programmprotokoll wurde als %1 gespeichert. Ordner und Namen sind darin ausgelassen.</translation>
    </message>
    <message>
        <source>Open a session first; which effects there can be depends on its machine.</source>
        <translation>Zuerst eine Sitzung öffnen; welche Effekte es geben kann, hängt von ihrer Maschine ab.</translation>
    </message>
    <message>
        <source>Open a session first; notes belong to it.</source>
        <translation>Zuerst eine Sitzung öffnen; Notizen gehören zu ihr.</translation>
    </message>
    <message>
        <source>A machine is being compensated. Quitting fades its compensation to zero and ends the loop; what was measured is kept.</source>
        <translation>Eine Maschine wird gerade kompensiert. Beim Beenden klingt ihre Kompensation auf null ab und der Regelkreis endet; was gemessen wurde, bleibt erhalten.</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is still running. Quitting cancels it; everything that was captured and every result that is done is kept.</source>
        <translation>„%1“ läuft noch. Beenden bricht es ab; alles Aufgenommene und jedes fertige Ergebnis bleibt erhalten.</translation>
    </message>
    <message>
        <source>Quit</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>Not possible now.</source>
        <translation>Jetzt nicht möglich.</translation>
    </message>
    <message>
        <source>Page %1</source>
        <translation>Seite %1</translation>
    </message>
    <message>
        <source>Help: %1</source>
        <translation>Hilfe: %1</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>&amp;Clear the list</source>
        <translation>Liste &amp;leeren</translation>
    </message>
    <message>
        <source>&amp;Write as files</source>
        <translation>Als Dateien &amp;schreiben</translation>
    </message>
    <message>
        <source>Files of: %1</source>
        <translation>Dateien zu: %1</translation>
    </message>
    <message>
        <source>Where the folder of the sample campaign is to be made</source>
        <translation>Wo der Ordner der Beispielkampagne angelegt werden soll</translation>
    </message>
    <message>
        <source>%1 is there already and is not written over; choose another folder.</source>
        <translation>%1 ist schon vorhanden und wird nicht überschrieben; einen anderen Ordner wählen.</translation>
    </message>
    <message>
        <source>Writing sample data: %1</source>
        <translation>Beispieldaten werden geschrieben: %1</translation>
    </message>
    <message>
        <source>The sample campaign was written to %1.</source>
        <translation>Die Beispielkampagne wurde nach %1 geschrieben.</translation>
    </message>
    <message>
        <source>Captures taken into the campaign: %1 of %2.</source>
        <translation>In die Kampagne übernommene Aufnahmen: %1 von %2.</translation>
    </message>
    <message>
        <source>And %1 more.</source>
        <translation>Und %1 weitere.</translation>
    </message>
    <message>
        <source>Printed on %1.</source>
        <translation>Auf %1 gedruckt.</translation>
    </message>
    <message>
        <source>Printed to %1.</source>
        <translation>In die Datei %1 gedruckt.</translation>
    </message>
    <message>
        <source>Open a session first.</source>
        <translation>Zuerst eine Sitzung öffnen.</translation>
    </message>
    <message>
        <source>%1 · %2 · %3</source>
        <translation>%1 · %2 · %3</translation>
    </message>
    <message>
        <source>The report has not been written yet; the page Report does.</source>
        <translation>Der Bericht ist noch nicht geschrieben; das geschieht auf der Seite „Bericht“.</translation>
    </message>
    <message>
        <source>&amp;Recent sessions</source>
        <translation>&amp;Letzte Sitzungen</translation>
    </message>
    <message>
        <source>Sample &amp;data</source>
        <translation>Beispiel&amp;daten</translation>
    </message>
    <message>
        <source>&amp;Print this page …</source>
        <translation>Diese Seite dr&amp;ucken …</translation>
    </message>
    <message>
        <source>Print the repor&amp;t …</source>
        <translation>Be&amp;richt drucken …</translation>
    </message>
    <message>
        <source>There is nothing to undo.</source>
        <translation>Es gibt nichts rückgängig zu machen.</translation>
    </message>
    <message>
        <source>There is nothing to redo.</source>
        <translation>Es gibt nichts zu wiederholen.</translation>
    </message>
    <message>
        <source>&amp;Preferences …</source>
        <translation>&amp;Einstellungen …</translation>
    </message>
    <message>
        <source>Ctrl+,</source>
        <translation>Ctrl+,</translation>
    </message>
    <message>
        <source>&amp;Find a command …</source>
        <translation>&amp;Befehl suchen …</translation>
    </message>
    <message>
        <source>Ctrl+K</source>
        <translation>Ctrl+K</translation>
    </message>
    <message>
        <source>This is the first step.</source>
        <translation>Dies ist der erste Schritt.</translation>
    </message>
    <message>
        <source>This is the last step.</source>
        <translation>Dies ist der letzte Schritt.</translation>
    </message>
    <message>
        <source>This page has nothing to run.</source>
        <translation>Auf dieser Seite gibt es nichts auszuführen.</translation>
    </message>
    <message>
        <source>Something that it needs is missing on the page.</source>
        <translation>Auf der Seite fehlt etwas, das dafür nötig ist.</translation>
    </message>
    <message>
        <source>What&apos;s &amp;new …</source>
        <translation>Ne&amp;uigkeiten …</translation>
    </message>
    <message>
        <source>&amp;What if …</source>
        <translation>&amp;Was wäre, wenn …</translation>
    </message>
    <message>
        <source>Ctrl+Shift+W</source>
        <translation>Ctrl+Shift+W</translation>
    </message>
    <message>
        <source>&amp;Exercise: find the missing effect …</source>
        <translation>&amp;Übung: den fehlenden Effekt finden …</translation>
    </message>
    <message>
        <source>Ctrl+Shift+X</source>
        <translation>Ctrl+Shift+X</translation>
    </message>
    <message>
        <source>Running the virtual machine: exercise %1</source>
        <translation>Die virtuelle Maschine läuft: Übung %1</translation>
    </message>
    <message>
        <source>&amp;Run the step, or go on</source>
        <translation>Schritt a&amp;usführen oder weitergehen</translation>
    </message>
    <message numerus="yes">
        <source>%n rows of log.csv</source>
        <translation>
            <numerusform>%n Zeile von log.csv</numerusform>
            <numerusform>%n Zeilen von log.csv</numerusform>
        </translation>
    </message>
    <message>
        <source>All steps are done and the report is written.</source>
        <translation>Alle Schritte sind erledigt, und der Bericht ist geschrieben.</translation>
    </message>
    <message>
        <source>Step %1 needs your review before you continue.</source>
        <translation>Schritt %1 bitte prüfen, dann fortfahren.</translation>
    </message>
    <message>
        <source>Run &amp;all steps</source>
        <translation>&amp;Alle Schritte ausführen</translation>
    </message>
    <message>
        <source>Ctrl+Shift+Return</source>
        <translation>Ctrl+Shift+Return</translation>
    </message>
    <message>
        <source>Redo: %1</source>
        <translation>Wiederholen: %1</translation>
    </message>
    <message>
        <source>Nothing that was calculated is outdated.</source>
        <translation>Nichts von dem, was berechnet wurde, ist veraltet.</translation>
    </message>
    <message>
        <source>What was outdated has been run: all results are current.</source>
        <translation>Veraltetes wurde ausgeführt: Alle Ergebnisse sind aktuell.</translation>
    </message>
    <message>
        <source>Still outdated: %1.</source>
        <translation>Noch veraltet: %1.</translation>
    </message>
    <message>
        <source>Run what is &amp;outdated</source>
        <translation>&amp;Veraltetes ausführen</translation>
    </message>
    <message>
        <source>Ctrl+Shift+R</source>
        <translation>Ctrl+Shift+R</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ManualWindow</name>
    <message>
        <source>Manual</source>
        <translation>Handbuch</translation>
    </message>
    <message>
        <source>Chapters of the manual</source>
        <translation>Kapitel des Handbuchs</translation>
    </message>
    <message>
        <source>The manual cannot be shown. %1</source>
        <translation>Das Handbuch lässt sich nicht anzeigen. %1</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::MessagePage</name>
    <message>
        <source>Nothing to do here with this campaign</source>
        <translation>Mit dieser Kampagne ist hier nichts zu tun</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::NewCapturePage</name>
    <message>
        <source>Say what measures, make a plan, and let every capture be checked as it arrives.</source>
        <translation>Angeben, womit gemessen wird, einen Plan erstellen und jede Aufnahme beim Eintreffen prüfen lassen.</translation>
    </message>
    <message>
        <source>Microscope</source>
        <translation>Mikroskop</translation>
    </message>
    <message>
        <source>Touch probe</source>
        <translation>Messtaster</translation>
    </message>
    <message>
        <source>Laser profiler</source>
        <translation>Laser-Profilsensor</translation>
    </message>
    <message>
        <source>Instrument</source>
        <translation>Messgerät</translation>
    </message>
    <message>
        <source>Arriving</source>
        <translation>Eingang</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Nothing is captured yet. Make a plan, then watch the folder into which the instrument writes.</source>
        <translation>Es ist noch nichts aufgenommen. Einen Plan erstellen, dann den Ordner überwachen, in den das Messgerät schreibt.</translation>
    </message>
    <message>
        <source>The plan is made. Watch the folder into which the instrument writes.</source>
        <translation>Der Plan ist erstellt. Den Ordner überwachen, in den das Messgerät schreibt.</translation>
    </message>
    <message>
        <source>Ready: take the captures of the plan. Each is checked as it arrives.</source>
        <translation>Bereit: die Aufnahmen des Plans machen. Jede wird beim Eintreffen geprüft.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::NewMeasurementDialog</name>
    <message>
        <source>New measurement</source>
        <translation>Neue Messung</translation>
    </message>
    <message>
        <source>Which machine is measured?</source>
        <translation>Welche Maschine wird gemessen?</translation>
    </message>
    <message>
        <source>Choose the one that is most alike: travels, chain, points and artefacts are edited on the page Machine. A machine.json of earlier measurements saves that work.</source>
        <translation>Die ähnlichste wählen: Verfahrwege, Kette, Punkte und Prüfkörper werden auf der Seite „Maschine“ bearbeitet. Eine machine.json früherer Messungen erspart diese Arbeit.</translation>
    </message>
    <message>
        <source>Machines to begin with</source>
        <translation>Maschinen als Ausgangspunkt</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Name of the machine</source>
        <translation>Name der Maschine</translation>
    </message>
    <message>
        <source>From a file …</source>
        <translation>Aus einer Datei …</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>Begin</source>
        <translation>Beginnen</translation>
    </message>
    <message>
        <source>The machine of this session: %1</source>
        <translation>Die Maschine dieser Sitzung: %1</translation>
    </message>
    <message>
        <source>As it is now, with its points and artefacts.</source>
        <translation>Wie sie jetzt ist, mit ihren Punkten und Prüfkörpern.</translation>
    </message>
    <message>
        <source>Three-axis mill, fiducials under a microscope</source>
        <translation>Dreiachsige Fräsmaschine, Messmarken unter dem Mikroskop</translation>
    </message>
    <message>
        <source>Vertical spindle, table moves in X and Y; five fiducials.</source>
        <translation>Senkrechte Spindel, Tisch bewegt sich in X und Y; fünf Messmarken.</translation>
    </message>
    <message>
        <source>Five-axis machining centre, hole bar and touch probe</source>
        <translation>Fünfachsiges Bearbeitungszentrum, Lochleiste und Messtaster</translation>
    </message>
    <message>
        <source>Vertical spindle, swivelling and turning table; a bar with seven holes.</source>
        <translation>Senkrechte Spindel, Dreh-Schwenktisch; eine Leiste mit sieben Löchern.</translation>
    </message>
    <message>
        <source>Horizontal machining centre, balls and star stylus</source>
        <translation>Horizontales Bearbeitungszentrum, Kugeln und Sterntaster</translation>
    </message>
    <message>
        <source>Horizontal spindle; four balls, five styli.</source>
        <translation>Waagerechte Spindel; vier Kugeln, fünf Tastereinsätze.</translation>
    </message>
    <message>
        <source>Gantry, free-form artefacts under a laser profiler</source>
        <translation>Portalmaschine, Freiform-Prüfkörper unter dem Laser-Profilsensor</translation>
    </message>
    <message>
        <source>Crossbeam that carries the profiler; four artefacts.</source>
        <translation>Querbalken, der den Profilsensor trägt; vier Prüfkörper.</translation>
    </message>
    <message>
        <source>Choose the machine description</source>
        <translation>Maschinenbeschreibung wählen</translation>
    </message>
    <message>
        <source>Machine (*.json)</source>
        <translation>Maschine (*.json)</translation>
    </message>
    <message>
        <source>%1 (from a file)</source>
        <translation>%1 (aus einer Datei)</translation>
    </message>
    <message>
        <source>three-axis mill</source>
        <translation>Dreiachsige Fräsmaschine</translation>
    </message>
    <message>
        <source>five-axis machining centre</source>
        <translation>Fünfachsiges Bearbeitungszentrum</translation>
    </message>
    <message>
        <source>horizontal machining centre</source>
        <translation>Horizontales Bearbeitungszentrum</translation>
    </message>
    <message>
        <source>gantry milling machine</source>
        <translation>Portalfräsmaschine</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::NewsDialog</name>
    <message>
        <source>What&apos;s new</source>
        <translation>Neuigkeiten</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::NextPanel</name>
    <message>
        <source>What to measure next</source>
        <translation>Was als Nächstes zu messen ist</translation>
    </message>
    <message>
        <source>Right one alone afterwards</source>
        <translation>Danach der richtige allein</translation>
    </message>
    <message>
        <source>Time / s</source>
        <translation>Zeit / s</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Program</source>
        <translation>Programm</translation>
    </message>
    <message>
        <source>How it was found</source>
        <translation>Wie es gefunden wurde</translation>
    </message>
    <message>
        <source>Effect tried</source>
        <translation>Geprüfter Effekt</translation>
    </message>
    <message>
        <source>Decision</source>
        <translation>Entscheidung</translation>
    </message>
    <message>
        <source>Gain in BIC</source>
        <translation>Gewinn in BIC</translation>
    </message>
    <message>
        <source>Why</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>Steps of the search</source>
        <translation>Schritte der Suche</translation>
    </message>
    <message>
        <source>Every step of the search appears here with its evidence.</source>
        <translation>Hier erscheint jeder Schritt der Suche mit seiner Evidenz.</translation>
    </message>
    <message>
        <source>Remainder: %1.</source>
        <translation>Rest: %1.</translation>
    </message>
    <message>
        <source>Nothing remains beyond the noise.</source>
        <translation>Über das Rauschen hinaus verbleibt nichts.</translation>
    </message>
    <message>
        <source>with it too something remains that no effect explains</source>
        <translation>auch damit verbleibt etwas, das kein Effekt erklärt</translation>
    </message>
    <message>
        <source>out again</source>
        <translation>wieder heraus</translation>
    </message>
    <message>
        <source>in</source>
        <translation>aufgenommen</translation>
    </message>
    <message>
        <source>not</source>
        <translation>nicht</translation>
    </message>
    <message>
        <source>After the search this says which measurement distinguishes the rivals.</source>
        <translation>Nach der Suche steht hier, welche Messung die konkurrierenden Erklärungen unterscheidet.</translation>
    </message>
    <message>
        <source>After a night at rest:</source>
        <translation>Nach einer Nacht im Stillstand:</translation>
    </message>
    <message>
        <source>%1 to %2 %3</source>
        <translation>%1 bis %2 %3</translation>
    </message>
    <message>
        <source>The instrument is off until the start.</source>
        <translation>Das Messgerät ist bis zum Beginn ausgeschaltet.</translation>
    </message>
    <message>
        <source>The table stands at its angles in turn.</source>
        <translation>Der Tisch steht nacheinander in seinen Winkeln.</translation>
    </message>
    <message>
        <source>To tell</source>
        <translation>Zu unterscheiden</translation>
    </message>
    <message>
        <source>What the machine does (h:min)</source>
        <translation>Was die Maschine tut (h:min)</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>When, from the start of the program (h:min)</source>
        <translation>Zeitpunkt ab Beginn des Programms (h:min)</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1 %</translation>
    </message>
    <message>
        <source>most probable one now: %1 %</source>
        <translation>zurzeit am wahrscheinlichsten: %1 %</translation>
    </message>
    <message>
        <source>No effect of the catalogue fits, so there are no rivals to distinguish. Log what else happens at the machine (hydraulics, pumps, doors, neighbours) at the times of the disagreement, and measure again.</source>
        <translation>Kein Effekt des Katalogs passt, daher gibt es keine konkurrierenden Erklärungen zu unterscheiden. Aufzeichnen, was sonst an der Maschine geschieht (Hydraulik, Pumpen, Türen, Nachbarn), wenn die Unterschiede auftreten, und erneut messen.</translation>
    </message>
    <message>
        <source>Nothing: measured and simulated agree.</source>
        <translation>Nichts: Messung und Simulation stimmen überein.</translation>
    </message>
    <message>
        <source>Nothing: no rival fits as well as the named effect.</source>
        <translation>Nichts: keine konkurrierende Erklärung passt so gut wie der benannte Effekt.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::NineParameterPage</name>
    <message>
        <source>No map</source>
        <translation>Keine Karte</translation>
    </message>
    <message>
        <source>The machine has no X or no Y axis; describe it on the page Machine.</source>
        <translation>Die Maschine hat keine X- oder keine Y-Achse; auf der Seite „Maschine“ beschreiben.</translation>
    </message>
    <message>
        <source>%1: other points minus checked points</source>
        <translation>%1: andere Punkte minus angekreuzte Punkte</translation>
    </message>
    <message>
        <source>%1 of state %2 against %3</source>
        <translation>%1 des Zustands %2 gegen %3</translation>
    </message>
    <message>
        <source>Fit the model</source>
        <translation>Modell anpassen</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Thermal state to fit</source>
        <translation>Anzupassender thermischer Zustand</translation>
    </message>
    <message>
        <source>Outliers</source>
        <translation>Ausreißer</translation>
    </message>
    <message>
        <source>How outliers are treated</source>
        <translation>Behandlung von Ausreißern</translation>
    </message>
    <message>
        <source>keep</source>
        <translation>behalten</translation>
    </message>
    <message>
        <source>Huber</source>
        <translation>Huber</translation>
    </message>
    <message>
        <source>Tukey</source>
        <translation>Tukey</translation>
    </message>
    <message>
        <source>Points: checked ones fit, the others validate</source>
        <translation>Punkte: angekreuzte passen an, die anderen validieren</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>x / mm</source>
        <translation>x / mm</translation>
    </message>
    <message>
        <source>y / mm</source>
        <translation>y / mm</translation>
    </message>
    <message>
        <source>EX / µm</source>
        <translation>EX / µm</translation>
    </message>
    <message>
        <source>EY / µm</source>
        <translation>EY / µm</translation>
    </message>
    <message>
        <source>EZ / µm</source>
        <translation>EZ / µm</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Points appear when there are observations.</source>
        <translation>Punkte erscheinen, sobald es Beobachtungen gibt.</translation>
    </message>
    <message>
        <source>rms of the fit</source>
        <translation>rms der Anpassung</translation>
    </message>
    <message>
        <source>rms of the validation</source>
        <translation>rms der Validierung</translation>
    </message>
    <message>
        <source>Condition number</source>
        <translation>Konditionszahl</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Meaning</source>
        <translation>Bedeutung</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Nine parameters with their uncertainty appear after the fit.</source>
        <translation>Nach der Anpassung erscheinen hier neun Parameter mit ihrer Unsicherheit.</translation>
    </message>
    <message>
        <source>Component</source>
        <translation>Komponente</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>Residuum</translation>
    </message>
    <message>
        <source>Used</source>
        <translation>Verwendet</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>Residuen</translation>
    </message>
    <message>
        <source>What the model does not explain appears after the fit.</source>
        <translation>Nach der Anpassung erscheint hier, was das Modell nicht erklärt.</translation>
    </message>
    <message>
        <source>Checked points</source>
        <translation>Angekreuzte Punkte</translation>
    </message>
    <message>
        <source>Other points</source>
        <translation>Andere Punkte</translation>
    </message>
    <message>
        <source>Difference</source>
        <translation>Differenz</translation>
    </message>
    <message>
        <source>p</source>
        <translation>p</translation>
    </message>
    <message>
        <source>Comparison of two sets of points</source>
        <translation>Vergleich zweier Punktsätze</translation>
    </message>
    <message>
        <source>Fit the model to compare sets of points.</source>
        <translation>Modell anpassen, um Punktsätze zu vergleichen.</translation>
    </message>
    <message>
        <source>Compare sets</source>
        <translation>Sätze vergleichen</translation>
    </message>
    <message>
        <source>Arrows</source>
        <translation>Pfeile</translation>
    </message>
    <message>
        <source>One scale</source>
        <translation>Eine Skala</translation>
    </message>
    <message>
        <source>The same limits for EX, EY and EZ, so that their pictures can be compared</source>
        <translation>Gleiche Grenzen für EX, EY und EZ, damit sich ihre Bilder vergleichen lassen</translation>
    </message>
    <message>
        <source>Relief</source>
        <translation>Relief</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Higher order</source>
        <translation>Höhere Ordnung</translation>
    </message>
    <message>
        <source>The heat map will appear here</source>
        <translation>Hier erscheint die Farbkarte</translation>
    </message>
    <message>
        <source>Fit the model: it is drawn over the table with the measured points on top.</source>
        <translation>Modell anpassen: es wird über dem Tisch gezeichnet, mit den gemessenen Punkten darüber.</translation>
    </message>
    <message>
        <source>choose state</source>
        <translation>Zustand wählen</translation>
    </message>
    <message>
        <source>treat outliers</source>
        <translation>Ausreißer behandeln</translation>
    </message>
    <message>
        <source>choose points</source>
        <translation>Punkte wählen</translation>
    </message>
    <message>
        <source>There are no observations yet. Evaluate the captures first.</source>
        <translation>Es gibt noch keine Beobachtungen. Zuerst die Aufnahmen auswerten.</translation>
    </message>
    <message>
        <source>Go to Calibrate</source>
        <translation>Zu „Kalibrieren“ wechseln</translation>
    </message>
    <message>
        <source>Changed since this was fitted: %1. Fit the model again.</source>
        <translation>Geändert seit der Anpassung: %1. Modell erneut anpassen.</translation>
    </message>
    <message>
        <source>Choose the points that fit, then press Fit the model.</source>
        <translation>Punkte wählen, die angepasst werden, dann „Modell anpassen“ drücken.</translation>
    </message>
    <message>
        <source>State %1 against %2: all nine parameters are determined.</source>
        <translation>Zustand %1 gegen %2: alle neun Parameter sind bestimmt.</translation>
    </message>
    <message>
        <source>not determined</source>
        <translation>nicht bestimmt</translation>
    </message>
    <message>
        <source>of higher order: at the edge of the measured points</source>
        <translation>von höherer Ordnung: am Rand der gemessenen Punkte</translation>
    </message>
    <message>
        <source>weight %1</source>
        <translation>Gewicht %1</translation>
    </message>
    <message>
        <source>fit</source>
        <translation>Anpassung</translation>
    </message>
    <message>
        <source>validation</source>
        <translation>Validierung</translation>
    </message>
    <message>
        <source>over the checked points</source>
        <translation>über die angekreuzten Punkte</translation>
    </message>
    <message>
        <source>over the other points</source>
        <translation>über die anderen Punkte</translation>
    </message>
    <message>
        <source>uncheck a point to validate</source>
        <translation>zum Validieren einen Punkt abwählen</translation>
    </message>
    <message>
        <source>χ² test: %1</source>
        <translation>χ²-Test: %1</translation>
    </message>
    <message>
        <source>no degrees of freedom left</source>
        <translation>keine Freiheitsgrade übrig</translation>
    </message>
    <message>
        <source>Uncheck at least three points: the checked set is then compared with the other one.</source>
        <translation>Mindestens drei Punkte abwählen: dann wird der angekreuzte Satz mit dem anderen verglichen.</translation>
    </message>
    <message>
        <source>Both sets of points give the same model within their uncertainty (p = %1).</source>
        <translation>Beide Punktsätze ergeben innerhalb ihrer Unsicherheit dasselbe Modell (p = %1).</translation>
    </message>
    <message>
        <source>The sets differ in %1: one of them contains an error that the model does not describe.</source>
        <translation>Die Sätze unterscheiden sich in %1: einer von ihnen enthält eine Abweichung, die das Modell nicht beschreibt.</translation>
    </message>
    <message>
        <source>Heat map %1</source>
        <translation>Farbkarte %1</translation>
    </message>
    <message>
        <source>Heat map %1 values</source>
        <translation>Werte der Farbkarte %1</translation>
    </message>
    <message>
        <source>Residual / σ</source>
        <translation>Residuum / σ</translation>
    </message>
    <message>
        <source>Reading the fit</source>
        <translation>Anpassung wird gelesen</translation>
    </message>
    <message>
        <source>Reading the points</source>
        <translation>Punkte werden gelesen</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::NoisePanel</name>
    <message>
        <source>Noise of a reading</source>
        <translation>Rauschen eines Messwerts</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Noise scale</source>
        <translation>Rauschfaktor</translation>
    </message>
    <message>
        <source>Common shift</source>
        <translation>Gemeinsame Verschiebung</translation>
    </message>
    <message>
        <source>Correlated</source>
        <translation>Korreliert</translation>
    </message>
    <message>
        <source>Noise of every component</source>
        <translation>Rauschen jeder Komponente</translation>
    </message>
    <message>
        <source>The noise found appears after the search.</source>
        <translation>Das gefundene Rauschen erscheint nach der Suche.</translation>
    </message>
    <message>
        <source>Outlying readings</source>
        <translation>Ausreißer</translation>
    </message>
    <message>
        <source>What is shown</source>
        <translation>Was gezeigt wird</translation>
    </message>
    <message>
        <source>Exclude …</source>
        <translation>Ausschließen …</translation>
    </message>
    <message>
        <source>Leave the marked readings out; they stay in the data and can be brought back</source>
        <translation>Markierte Messwerte auslassen; sie bleiben in den Daten und können zurückgeholt werden</translation>
    </message>
    <message>
        <source>No common shift</source>
        <translation>Keine gemeinsame Verschiebung</translation>
    </message>
    <message>
        <source>Where all points of a state are shifted together (re-referencing, refocus), the shift of each state appears here.</source>
        <translation>Wo alle Punkte eines Zustands gemeinsam verschoben sind (neue Referenz, neuer Fokus), erscheint die Verschiebung jedes Zustands hier.</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Time</source>
        <translation>Zeit</translation>
    </message>
    <message>
        <source>Common shift of every state</source>
        <translation>Gemeinsame Verschiebung jedes Zustands</translation>
    </message>
    <message>
        <source>No state is shifted as a whole.</source>
        <translation>Kein Zustand ist als Ganzes verschoben.</translation>
    </message>
    <message>
        <source>Row</source>
        <translation>Zeile</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Deviation / σ</source>
        <translation>Abweichung / σ</translation>
    </message>
    <message>
        <source>Status</source>
        <translation>Status</translation>
    </message>
    <message>
        <source>No reading lies far from all others.</source>
        <translation>Kein Messwert liegt weit von allen anderen entfernt.</translation>
    </message>
    <message>
        <source>The series of the reading</source>
        <translation>Reihe des Messwerts</translation>
    </message>
    <message>
        <source>Choose a reading in the table.</source>
        <translation>Messwert in der Tabelle wählen.</translation>
    </message>
    <message>
        <source>Scatter of the readings over their stated σ</source>
        <translation>Streuung der Messwerte bezogen auf ihr angegebenes σ</translation>
    </message>
    <message>
        <source>Standard deviation of the shift common to all points of a state</source>
        <translation>Standardabweichung der Verschiebung, die allen Punkten eines Zustands gemeinsam ist</translation>
    </message>
    <message>
        <source>%1 % over %2</source>
        <translation>%1 % über %2</translation>
    </message>
    <message>
        <source>Part of the variance of the noise that is correlated in time, and its correlation time</source>
        <translation>Zeitlich korrelierter Anteil der Varianz des Rauschens und seine Korrelationszeit</translation>
    </message>
    <message>
        <source>Noise scale: how much the readings scatter, over their stated σ.</source>
        <translation>Rauschfaktor: Streuung der Messwerte bezogen auf ihr angegebenes σ.</translation>
    </message>
    <message>
        <source>Tails: heavier than normal (Student t, %1 degrees of freedom); readings far out have little weight.</source>
        <translation>Ausläufer: breiter als bei der Normalverteilung (Student-t, %1 Freiheitsgrade); weit außen liegende Messwerte haben wenig Gewicht.</translation>
    </message>
    <message>
        <source>Tails: normal distribution.</source>
        <translation>Ausläufer: Normalverteilung.</translation>
    </message>
    <message>
        <source>Clock: the log is %1 ahead of the observations.</source>
        <translation>Uhr: das Protokoll geht gegenüber den Beobachtungen %1 vor.</translation>
    </message>
    <message>
        <source>Clock: the log is %1 behind the observations.</source>
        <translation>Uhr: das Protokoll geht gegenüber den Beobachtungen %1 nach.</translation>
    </message>
    <message>
        <source>Clock: these data show no offset between log and observations.</source>
        <translation>Uhr: diese Daten zeigen keinen Versatz zwischen Protokoll und Beobachtungen.</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>Common shift / %1, %2</source>
        <translation>Gemeinsame Verschiebung / %1, %2</translation>
    </message>
    <message>
        <source>Common shift / %1</source>
        <translation>Gemeinsame Verschiebung / %1</translation>
    </message>
    <message>
        <source>little weight</source>
        <translation>wenig Gewicht</translation>
    </message>
    <message>
        <source>Lies far from all others and was given little weight</source>
        <translation>Liegt weit von allen anderen entfernt und erhielt wenig Gewicht</translation>
    </message>
    <message>
        <source>excluded</source>
        <translation>ausgeschlossen</translation>
    </message>
    <message>
        <source>Excluded: %1</source>
        <translation>Ausgeschlossen: %1</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>Measured: %1</source>
        <translation>Gemessen: %1</translation>
    </message>
    <message>
        <source>Outlying readings (%1)</source>
        <translation>Ausreißer (%1)</translation>
    </message>
    <message>
        <source>Bring back</source>
        <translation>Zurückholen</translation>
    </message>
    <message>
        <source>%1 of %2: residual with the effects found, ± 2 σ of the noise</source>
        <translation>%1 von %2: Residuum mit den gefundenen Effekten, ± 2 σ des Rauschens</translation>
    </message>
    <message>
        <source>%1 residual / %2</source>
        <translation>Residuum %1 / %2</translation>
    </message>
    <message>
        <source>noise, ± 2 σ</source>
        <translation>Rauschen, ± 2 σ</translation>
    </message>
    <message>
        <source>residual</source>
        <translation>Residuum</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>Common shift of states</source>
        <translation>Gemeinsame Verschiebung der Zustände</translation>
    </message>
    <message>
        <source>Common shift over time</source>
        <translation>Gemeinsame Verschiebung über der Zeit</translation>
    </message>
    <message numerus="yes">
        <source>%n readings lie far from all others; they have little weight.</source>
        <translation>
            <numerusform>Ein Messwert liegt weit von allen anderen; er hat wenig Gewicht.</numerusform>
            <numerusform>%n Messwerte liegen weit von allen anderen; sie haben wenig Gewicht.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::NotesDialog</name>
    <message>
        <source>Notes</source>
        <translation>Notizen</translation>
    </message>
    <message>
        <source>When (UTC)</source>
        <translation>Zeitpunkt (UTC)</translation>
    </message>
    <message>
        <source>About</source>
        <translation>Zu</translation>
    </message>
    <message>
        <source>Item</source>
        <translation>Element</translation>
    </message>
    <message>
        <source>Note</source>
        <translation>Notiz</translation>
    </message>
    <message>
        <source>Notes that you add appear here and in the report.</source>
        <translation>Hinzugefügte Notizen erscheinen hier und im Bericht.</translation>
    </message>
    <message>
        <source>What the note is about</source>
        <translation>Worauf sich die Notiz bezieht</translation>
    </message>
    <message>
        <source>A step, or what you type: a result, the session</source>
        <translation>Ein Schritt oder eine eigene Eingabe: ein Ergebnis, die Sitzung</translation>
    </message>
    <message>
        <source>Session</source>
        <translation>Sitzung</translation>
    </message>
    <message>
        <source>Which item of it the note is about</source>
        <translation>Auf welches Element davon sich die Notiz bezieht</translation>
    </message>
    <message>
        <source>A capture or an observation; what is picked on the page, or one that was taken out</source>
        <translation>Eine Aufnahme oder Beobachtung; was auf der Seite gewählt ist oder ausgeschlossen wurde</translation>
    </message>
    <message>
        <source>the step as a whole</source>
        <translation>der Schritt als Ganzes</translation>
    </message>
    <message>
        <source>Text of the note</source>
        <translation>Text der Notiz</translation>
    </message>
    <message>
        <source>What somebody who reads the report should know</source>
        <translation>Was Leser des Berichts wissen sollten</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Entfernen</translation>
    </message>
    <message>
        <source>Add the note</source>
        <translation>Notiz hinzufügen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::Page</name>
    <message>
        <source>Model over time</source>
        <translation>Modell über der Zeit</translation>
    </message>
    <message>
        <source>Model of a state</source>
        <translation>Modell eines Zustands</translation>
    </message>
    <message>
        <source>Identify how these errors follow temperatures and speeds of the log</source>
        <translation>Identifizieren, wie diese Abweichungen den Temperaturen und Drehzahlen des Protokolls folgen</translation>
    </message>
    <message>
        <source>Back to the model of the instrument: one thermal state, or every cycle by itself</source>
        <translation>Zurück zum Modell des Messgeräts: ein thermischer Zustand oder jeder Zyklus für sich</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::PageView</name>
    <message>
        <source>Pages of the report</source>
        <translation>Seiten des Berichts</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ParameterCard</name>
    <message>
        <source>off</source>
        <translation>aus</translation>
    </message>
    <message>
        <source>A mechanism that the simulation does not have; it may well be %1.</source>
        <translation>Ein Mechanismus, den die Simulation nicht hat; gut möglich, dass es %1 ist.</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Parameters of the simulator</source>
        <translation>Parameter des Simulators</translation>
    </message>
    <message>
        <source>Choose simulator.json: the parameters of the simulation appear here.</source>
        <translation>simulator.json wählen: hier erscheinen die Parameter der Simulation.</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>What it is</source>
        <translation>Was es ist</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Bounds</source>
        <translation>Grenzen</translation>
    </message>
    <message>
        <source>Can cause</source>
        <translation>Kann verursachen</translation>
    </message>
    <message>
        <source>Put in</source>
        <translation>Einsetzen</translation>
    </message>
    <message>
        <source>or</source>
        <translation>oder</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 bis %2</translation>
    </message>
    <message>
        <source>Can cause: %1</source>
        <translation>Kann verursachen: %1</translation>
    </message>
    <message>
        <source>Bounds: %1</source>
        <translation>Grenzen: %1</translation>
    </message>
    <message>
        <source>Free %1 in the simulation when you press Put it into the simulation</source>
        <translation>%1 in der Simulation freigeben, wenn „In die Simulation einsetzen“ gedrückt wird</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Nachher</translation>
    </message>
    <message>
        <source>no influence</source>
        <translation>kein Einfluss</translation>
    </message>
    <message>
        <source>at its bound</source>
        <translation>an der Grenze</translation>
    </message>
    <message>
        <source>put in</source>
        <translation>eingesetzt</translation>
    </message>
    <message>
        <source>kept</source>
        <translation>beibehalten</translation>
    </message>
    <message>
        <source>adjusted</source>
        <translation>angepasst</translation>
    </message>
    <message>
        <source>adjusted within its stated uncertainty</source>
        <translation>innerhalb der angegebenen Unsicherheit angepasst</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::PlanPanel</name>
    <message>
        <source>Capture</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Due / min</source>
        <translation>Fällig / min</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>What to do</source>
        <translation>Was zu tun ist</translation>
    </message>
    <message>
        <source>Measurement plan</source>
        <translation>Messplan</translation>
    </message>
    <message>
        <source>Make a plan: it says what to measure next and when.</source>
        <translation>Plan erstellen: er sagt, was wann als Nächstes zu messen ist.</translation>
    </message>
    <message>
        <source> states</source>
        <translation> Zustände</translation>
    </message>
    <message>
        <source>Number of thermal states</source>
        <translation>Anzahl der thermischen Zustände</translation>
    </message>
    <message>
        <source>every </source>
        <translation>alle </translation>
    </message>
    <message>
        <source> min</source>
        <translation> min</translation>
    </message>
    <message>
        <source>Time between thermal states</source>
        <translation>Zeit zwischen thermischen Zuständen</translation>
    </message>
    <message>
        <source>New plan</source>
        <translation>Neuer Plan</translation>
    </message>
    <message>
        <source>All points or artefacts of the machine in every thermal state; what is captured stays</source>
        <translation>Alle Punkte oder Prüfkörper der Maschine in jedem thermischen Zustand; bereits Aufgenommenes bleibt</translation>
    </message>
    <message>
        <source>new measurement plan</source>
        <translation>neuer Messplan</translation>
    </message>
    <message>
        <source>There is no plan yet. It says what to measure when, and tells which capture a file is that arrives.</source>
        <translation>Es gibt noch keinen Plan. Er sagt, was wann zu messen ist und zu welcher Aufnahme eine eintreffende Datei gehört.</translation>
    </message>
    <message>
        <source>%1 of %2 captured</source>
        <translation>%1 von %2 aufgenommen</translation>
    </message>
    <message>
        <source>captured</source>
        <translation>aufgenommen</translation>
    </message>
    <message>
        <source>next</source>
        <translation>als Nächstes</translation>
    </message>
    <message>
        <source>open</source>
        <translation>offen</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::PlantPage</name>
    <message>
        <source>Plant</source>
        <translation>Werk</translation>
    </message>
    <message>
        <source>Open the store of your plant to see which machine is due, and what has changed.</source>
        <translation>Datenbank des Werks öffnen, um zu sehen, welche Maschine fällig ist und was sich geändert hat.</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Zurück</translation>
    </message>
    <message>
        <source>Plant store</source>
        <translation>Werksdatenbank</translation>
    </message>
    <message>
        <source>plant.sqlite, or postgresql:host=NAME dbname=plant user=NAME</source>
        <translation>plant.sqlite oder postgresql:host=NAME dbname=plant user=NAME</translation>
    </message>
    <message>
        <source>A file, or a PostgreSQL server; its password stands in the file that PGPASSFILE names</source>
        <translation>Eine Datei oder ein PostgreSQL-Server; dessen Passwort steht in der Datei, die PGPASSFILE nennt</translation>
    </message>
    <message>
        <source>File …</source>
        <translation>Datei …</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Publish this session</source>
        <translation>Diese Sitzung veröffentlichen</translation>
    </message>
    <message>
        <source>Campaigns of the open session with their newest results; raw captures stay where they are</source>
        <translation>Kampagnen der offenen Sitzung mit ihren neuesten Ergebnissen; Rohaufnahmen bleiben, wo sie sind</translation>
    </message>
    <message>
        <source>Open a plant store</source>
        <translation>Werksdatenbank öffnen</translation>
    </message>
    <message>
        <source>Plant store (*.sqlite)</source>
        <translation>Werksdatenbank (*.sqlite)</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Next</source>
        <translation>Nächste Messung</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Last</source>
        <translation>Letzte</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Machines</source>
        <translation>Maschinen</translation>
    </message>
    <message>
        <source>Machines appear here once campaigns are published.</source>
        <translation>Maschinen erscheinen hier, sobald Kampagnen veröffentlicht sind.</translation>
    </message>
    <message>
        <source>Report …</source>
        <translation>Bericht …</translation>
    </message>
    <message>
        <source>State, events, trends and model of the selected machine as one HTML file</source>
        <translation>Zustand, Ereignisse, Verläufe und Modell der gewählten Maschine als eine HTML-Datei</translation>
    </message>
    <message>
        <source>Report of the machine</source>
        <translation>Bericht der Maschine</translation>
    </message>
    <message>
        <source>Report (*.html)</source>
        <translation>Bericht (*.html)</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>No trend yet</source>
        <translation>Noch kein Verlauf</translation>
    </message>
    <message>
        <source>Select a machine that has been measured at least twice.</source>
        <translation>Eine Maschine wählen, die mindestens zweimal gemessen wurde.</translation>
    </message>
    <message>
        <source>Campaign</source>
        <translation>Kampagne</translation>
    </message>
    <message>
        <source>Date</source>
        <translation>Datum</translation>
    </message>
    <message>
        <source>Published by</source>
        <translation>Veröffentlicht von</translation>
    </message>
    <message>
        <source>Campaigns</source>
        <translation>Kampagnen</translation>
    </message>
    <message>
        <source>Select a machine.</source>
        <translation>Maschine wählen.</translation>
    </message>
    <message>
        <source>Comparison</source>
        <translation>Vergleich</translation>
    </message>
    <message>
        <source>Check two or more campaigns to see them side by side.</source>
        <translation>Zwei oder mehr Kampagnen ankreuzen, um sie nebeneinander zu sehen.</translation>
    </message>
    <message>
        <source>What was done to the machine</source>
        <translation>Was an der Maschine getan wurde</translation>
    </message>
    <message>
        <source>When it was done (UTC)</source>
        <translation>Wann es getan wurde (UTC)</translation>
    </message>
    <message>
        <source>UTC: a day such as 2026-01-31, or a time such as 2026-01-31T08:00:00Z</source>
        <translation>UTC: ein Tag wie 2026-01-31 oder ein Zeitpunkt wie 2026-01-31T08:00:00Z</translation>
    </message>
    <message>
        <source>Note on the event</source>
        <translation>Bemerkung zum Ereignis</translation>
    </message>
    <message>
        <source>A few words</source>
        <translation>Einige Worte</translation>
    </message>
    <message>
        <source>Enter event</source>
        <translation>Ereignis eintragen</translation>
    </message>
    <message>
        <source>What was done to the selected machine; limits of its trends begin anew after it</source>
        <translation>Was an der gewählten Maschine getan wurde; die Grenzen ihrer Verläufe beginnen danach neu</translation>
    </message>
    <message>
        <source>Trend</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Batches</source>
        <translation>Batch-Aufträge</translation>
    </message>
    <message>
        <source>Help on the plant</source>
        <translation>Hilfe zum Werk</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Hilfe</translation>
    </message>
    <message>
        <source>Reading the plant store</source>
        <translation>Werksdatenbank wird gelesen</translation>
    </message>
    <message>
        <source>…</source>
        <translation>…</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keine</translation>
    </message>
    <message>
        <source>holds</source>
        <translation>gilt</translation>
    </message>
    <message>
        <source>no longer holds</source>
        <translation>gilt nicht mehr</translation>
    </message>
    <message>
        <source>due for %1</source>
        <translation>fällig seit %1</translation>
    </message>
    <message>
        <source>Looking at models</source>
        <translation>Modelle werden geprüft</translation>
    </message>
    <message>
        <source>Reading trends</source>
        <translation>Verläufe werden gelesen</translation>
    </message>
    <message>
        <source>moving average (EWMA)</source>
        <translation>gleitender Mittelwert (EWMA)</translation>
    </message>
    <message>
        <source>control limits</source>
        <translation>Eingriffsgrenzen</translation>
    </message>
    <message>
        <source>time since %1 / d</source>
        <translation>Zeit seit %1 / d</translation>
    </message>
    <message>
        <source>No change that is more than chance.</source>
        <translation>Keine Änderung, die mehr als Zufall ist.</translation>
    </message>
    <message>
        <source>Comparing campaigns</source>
        <translation>Kampagnen werden verglichen</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Largest difference</source>
        <translation>Größte Differenz</translation>
    </message>
    <message>
        <source>%1 standard uncertainties</source>
        <translation>%1 Standardunsicherheiten</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is not a date up to now; allowed: UTC such as 2026-01-31 or 2026-01-31T08:00:00Z.</source>
        <translation>„%1“ ist kein Datum bis heute; zulässig: UTC, etwa 2026-01-31 oder 2026-01-31T08:00:00Z.</translation>
    </message>
    <message>
        <source>Entering an event</source>
        <translation>Ereignis wird eingetragen</translation>
    </message>
    <message>
        <source>Entered for %1: %2 on %3.</source>
        <translation>Eingetragen für %1: %2 am %3.</translation>
    </message>
    <message>
        <source>Writing the report of %1</source>
        <translation>Bericht von %1 wird geschrieben</translation>
    </message>
    <message>
        <source>The report is in %1.</source>
        <translation>Der Bericht ist in %1.</translation>
    </message>
    <message>
        <source>Publishing to the plant store</source>
        <translation>Veröffentlichung in der Werksdatenbank</translation>
    </message>
    <message>
        <source>%1 waiting in the session until the next publishing. %2</source>
        <translation>%1 warten in der Sitzung bis zur nächsten Veröffentlichung. %2</translation>
    </message>
    <message>
        <source>Published: new %1 and %2; there already %3 and %4.</source>
        <translation>Veröffentlicht: neu %1 und %2; schon vorhanden %3 und %4.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::Plot</name>
    <message>
        <source>%1 over %2</source>
        <translation>%1 über %2</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::PreferencesDialog</name>
    <message>
        <source>As the system</source>
        <translation>Wie das System</translation>
    </message>
    <message>
        <source>Preferences</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Look and language</source>
        <translation>Aussehen und Sprache</translation>
    </message>
    <message>
        <source>Theme</source>
        <translation>Farbschema</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Hell</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Dunkel</translation>
    </message>
    <message>
        <source>Language</source>
        <translation>Sprache</translation>
    </message>
    <message>
        <source>Language, from the next start</source>
        <translation>Sprache, ab dem nächsten Start</translation>
    </message>
    <message>
        <source>Decimals of measured lengths in mm</source>
        <translation>Nachkommastellen gemessener Längen in mm</translation>
    </message>
    <message>
        <source>As each page finds fitting</source>
        <translation>Wie es auf jeder Seite passt</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>Measured lengths</source>
        <translation>Gemessene Längen</translation>
    </message>
    <message>
        <source>Folders</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>Folder for new sessions</source>
        <translation>Ordner für neue Sitzungen</translation>
    </message>
    <message>
        <source>Choose …</source>
        <translation>Wählen …</translation>
    </message>
    <message>
        <source>Choose the folder for new sessions</source>
        <translation>Ordner für neue Sitzungen wählen</translation>
    </message>
    <message>
        <source>New sessions</source>
        <translation>Neue Sitzungen</translation>
    </message>
    <message>
        <source>Goals of a new campaign</source>
        <translation>Ziele einer neuen Kampagne</translation>
    </message>
    <message>
        <source>Goal of displacements</source>
        <translation>Ziel für Verschiebungen</translation>
    </message>
    <message>
        <source>Goal of rotations</source>
        <translation>Ziel für Drehungen</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keines</translation>
    </message>
    <message>
        <source>Displacements</source>
        <translation>Verschiebungen</translation>
    </message>
    <message>
        <source>Rotations</source>
        <translation>Drehungen</translation>
    </message>
    <message>
        <source>What may remain after compensation. The step Verify keeps the goal of each campaign.</source>
        <translation>Was nach der Kompensation übrig bleiben darf. Der Schritt „Verifizieren“ behält das Ziel jeder Kampagne.</translation>
    </message>
    <message>
        <source>Ask</source>
        <translation>Nachfragen</translation>
    </message>
    <message>
        <source>before quitting while work is running</source>
        <translation>vor dem Beenden bei laufender Arbeit</translation>
    </message>
    <message>
        <source>Ask before quitting while work is running</source>
        <translation>Vor dem Beenden bei laufender Arbeit nachfragen</translation>
    </message>
    <message>
        <source>before an edited effect is discarded</source>
        <translation>vor dem Verwerfen eines bearbeiteten Effekts</translation>
    </message>
    <message>
        <source>Ask before an edited effect is discarded</source>
        <translation>Vor dem Verwerfen eines bearbeiteten Effekts nachfragen</translation>
    </message>
    <message>
        <source>Reset all</source>
        <translation>Alle zurücksetzen</translation>
    </message>
    <message>
        <source>Reset all preferences</source>
        <translation>Alle Einstellungen zurücksetzen</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Nothing can be written to &quot;%1&quot;; allowed: a folder of yours, from the root on. New sessions go on to %2.</source>
        <translation>In „%1“ kann nicht geschrieben werden; zulässig: ein eigener Ordner, mit vollständigem Pfad. Neue Sitzungen kommen weiterhin nach %2.</translation>
    </message>
    <message>
        <source>Units and numbers</source>
        <translation>Einheiten und Zahlen</translation>
    </message>
    <message>
        <source>Lengths and errors</source>
        <translation>Längen und Abweichungen</translation>
    </message>
    <message>
        <source>Angles</source>
        <translation>Winkel</translation>
    </message>
    <message>
        <source>Temperatures</source>
        <translation>Temperaturen</translation>
    </message>
    <message>
        <source>On screen. Files, exports, reports and the command line have µm, mm, µrad and °C; what is typed into the files of machine, artefacts and effects has the unit of the file.</source>
        <translation>Am Bildschirm. Dateien, Ausgaben, Berichte und die Kommandozeile haben µm, mm, µrad und °C; was in die Dateien von Maschine, Prüfkörpern und Effekten eingetragen wird, hat die Einheit der Datei.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ProfilerCalibrationPage</name>
    <message>
        <source>Find where the profiler sits in the tool frame, and register every scan onto the first one.</source>
        <translation>Bestimmen, wo der Profilsensor im Werkzeugkoordinatensystem sitzt, und jeden Scan auf den ersten registrieren.</translation>
    </message>
    <message>
        <source>Evaluate the scans</source>
        <translation>Scans auswerten</translation>
    </message>
    <message>
        <source>Rim of the pocket, rms</source>
        <translation>Rand der Tasche, rms</translation>
    </message>
    <message>
        <source>Plate, rms</source>
        <translation>Platte, rms</translation>
    </message>
    <message>
        <source>Scans compared</source>
        <translation>Verglichene Scans</translation>
    </message>
    <message>
        <source>Scans left out</source>
        <translation>Ausgelassene Scans</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>From the scan</source>
        <translation>Aus dem Scan</translation>
    </message>
    <message>
        <source>Calibration</source>
        <translation>Kalibrierung</translation>
    </message>
    <message>
        <source>Three angles and three lengths with their uncertainty appear after the evaluation.</source>
        <translation>Nach der Auswertung erscheinen hier drei Winkel und drei Längen mit ihrer Unsicherheit.</translation>
    </message>
    <message>
        <source>Scan</source>
        <translation>Scan</translation>
    </message>
    <message>
        <source>X</source>
        <translation>X</translation>
    </message>
    <message>
        <source>Y</source>
        <translation>Y</translation>
    </message>
    <message>
        <source>Z</source>
        <translation>Z</translation>
    </message>
    <message>
        <source>rms / µm</source>
        <translation>rms / µm</translation>
    </message>
    <message>
        <source>Registrations</source>
        <translation>Registrierungen</translation>
    </message>
    <message>
        <source>The deviation at every artefact appears after the evaluation.</source>
        <translation>Nach der Auswertung erscheint hier die Abweichung an jedem Prüfkörper.</translation>
    </message>
    <message>
        <source>At the artefacts</source>
        <translation>An den Prüfkörpern</translation>
    </message>
    <message>
        <source>Why it was left out</source>
        <translation>Grund des Auslassens</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>Ausgelassen</translation>
    </message>
    <message>
        <source>Nothing was left out.</source>
        <translation>Es wurde nichts ausgelassen.</translation>
    </message>
    <message>
        <source>Residuals of the rim</source>
        <translation>Residuen des Randes</translation>
    </message>
    <message>
        <source>Angle around the pocket / °</source>
        <translation>Winkel um die Tasche / °</translation>
    </message>
    <message>
        <source>Distance from the circle / µm</source>
        <translation>Abstand vom Kreis / µm</translation>
    </message>
    <message>
        <source>Residuals will appear here</source>
        <translation>Hier erscheinen die Residuen</translation>
    </message>
    <message>
        <source>Evaluate the scans: every crossing of the rim is compared with the fitted circle.</source>
        <translation>Scans auswerten: jeder Übergang am Rand wird mit dem angepassten Kreis verglichen.</translation>
    </message>
    <message>
        <source>Reading the evaluation</source>
        <translation>Auswertung wird gelesen</translation>
    </message>
    <message>
        <source>Press Evaluate the scans. Those that cannot be used are listed with the reason, the others are evaluated.</source>
        <translation>„Scans auswerten“ drücken. Unbrauchbare werden mit Grund aufgeführt, die übrigen ausgewertet.</translation>
    </message>
    <message>
        <source>Changed since this was evaluated: %1. Evaluate again.</source>
        <translation>Geändert seit der Auswertung: %1. Erneut auswerten.</translation>
    </message>
    <message>
        <source>Deviations found: %1; see what the calibration cannot determine.</source>
        <translation>Gefundene Abweichungen: %1; beachten, was die Kalibrierung nicht bestimmen kann.</translation>
    </message>
    <message>
        <source> And %1 more.</source>
        <translation> Und %1 weitere.</translation>
    </message>
    <message>
        <source>Deviations found: %1, no warnings.</source>
        <translation>Gefundene Abweichungen: %1, keine Warnungen.</translation>
    </message>
    <message>
        <source>α about X</source>
        <translation>α um X</translation>
    </message>
    <message>
        <source>β about Y</source>
        <translation>β um Y</translation>
    </message>
    <message>
        <source>γ about Z</source>
        <translation>γ um Z</translation>
    </message>
    <message>
        <source>dx</source>
        <translation>dx</translation>
    </message>
    <message>
        <source>dy</source>
        <translation>dy</translation>
    </message>
    <message>
        <source>dz</source>
        <translation>dz</translation>
    </message>
    <message>
        <source>no: taken from the mounting</source>
        <translation>nein: aus dem Anbau übernommen</translation>
    </message>
    <message>
        <source>determined</source>
        <translation>bestimmt</translation>
    </message>
    <message>
        <source>%1 crossings</source>
        <translation>%1 Übergänge</translation>
    </message>
    <message>
        <source>around the pocket</source>
        <translation>rings um die Tasche</translation>
    </message>
    <message>
        <source>Used</source>
        <translation>Verwendet</translation>
    </message>
    <message>
        <source>%1 / µm</source>
        <translation>%1 / µm</translation>
    </message>
    <message>
        <source>reference</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>µrad</source>
        <translation>µrad</translation>
    </message>
    <message>
        <source>%1 % of the reference seen</source>
        <translation>%1 % der Referenz erfasst</translation>
    </message>
    <message>
        <source>All others are compared with this scan</source>
        <translation>Alle anderen werden mit diesem Scan verglichen</translation>
    </message>
    <message>
        <source>Not observed under this scan model</source>
        <translation>Unter diesem Scanmodell nicht beobachtbar</translation>
    </message>
    <message>
        <source>scan model %1</source>
        <translation>Scanmodell %1</translation>
    </message>
    <message>
        <source>Left out (%1)</source>
        <translation>Ausgelassen (%1)</translation>
    </message>
    <message>
        <source>every scan was used</source>
        <translation>alle Scans wurden verwendet</translation>
    </message>
    <message>
        <source>see the list</source>
        <translation>siehe Liste</translation>
    </message>
    <message>
        <source>Calibration of the profiler</source>
        <translation>Kalibrierung des Profilsensors</translation>
    </message>
    <message>
        <source>Deviations at the artefacts</source>
        <translation>Abweichungen an den Prüfkörpern</translation>
    </message>
    <message>
        <source>the surface has changed its shape by %1 µm rms</source>
        <translation>die Oberfläche hat ihre Form um %1 µm rms geändert</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ReferencePanel</name>
    <message>
        <source>Parameter to compare</source>
        <translation>Zu vergleichender Parameter</translation>
    </message>
    <message>
        <source>Load a record …</source>
        <translation>Aufzeichnung laden …</translation>
    </message>
    <message>
        <source>CSV with time_s, value and, if known, sigma, in the unit of the parameter</source>
        <translation>CSV mit time_s, value und, falls bekannt, sigma, in der Einheit des Parameters</translation>
    </message>
    <message>
        <source>Probe and reference will appear here</source>
        <translation>Hier erscheinen Messtaster und Referenz</translation>
    </message>
    <message>
        <source>Evaluate the touches, then load what a grid encoder or interferometer recorded meanwhile.</source>
        <translation>Antastungen auswerten, dann laden, was ein Kreuzgittermessgerät oder Interferometer inzwischen aufgezeichnet hat.</translation>
    </message>
    <message>
        <source>The difference will appear here</source>
        <translation>Hier erscheint die Differenz</translation>
    </message>
    <message>
        <source>With its uncertainty, cycle by cycle.</source>
        <translation>Mit ihrer Unsicherheit, Zyklus für Zyklus.</translation>
    </message>
    <message>
        <source>Record of the reference instrument</source>
        <translation>Aufzeichnung des Referenzgeräts</translation>
    </message>
    <message>
        <source>Record (*.csv)</source>
        <translation>Aufzeichnung (*.csv)</translation>
    </message>
    <message>
        <source>compare another parameter</source>
        <translation>anderen Parameter vergleichen</translation>
    </message>
    <message>
        <source>Evaluate the touches first; then a record can be compared with them.</source>
        <translation>Zuerst die Antastungen auswerten; dann lässt sich eine Aufzeichnung mit ihnen vergleichen.</translation>
    </message>
    <message>
        <source>load %1</source>
        <translation>%1 laden</translation>
    </message>
    <message>
        <source>Probe</source>
        <translation>Messtaster</translation>
    </message>
    <message>
        <source>Probe minus reference</source>
        <translation>Messtaster minus Referenz</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>Difference / %1</source>
        <translation>Differenz / %1</translation>
    </message>
    <message>
        <source>%1 differs from the reference by %2 rms, at most %3 %4; %5 % of %6 cycles agree within two standard uncertainties; correlation %7. A constant of %8 %4 is taken out: both zeros are arbitrary.</source>
        <translation>%1 weicht um %2 rms von der Referenz ab, höchstens %3 %4; %5 % von %6 Zyklen stimmen innerhalb von zwei Standardunsicherheiten überein; Korrelation %7. Eine Konstante von %8 %4 ist abgezogen: beide Nullpunkte sind willkürlich.</translation>
    </message>
    <message>
        <source>Probe and reference</source>
        <translation>Messtaster und Referenz</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::RemainderPanel</name>
    <message>
        <source>rms</source>
        <translation>rms</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>Residuum</translation>
    </message>
    <message>
        <source>Effects</source>
        <translation>Effekte</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>Remainder</source>
        <translation>Rest</translation>
    </message>
    <message>
        <source>Remainder of every component</source>
        <translation>Rest jeder Komponente</translation>
    </message>
    <message>
        <source>Components appear after the search.</source>
        <translation>Komponenten erscheinen nach der Suche.</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Largest</source>
        <translation>Größte</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Zeitpunkt</translation>
    </message>
    <message>
        <source>Remainder at every point</source>
        <translation>Rest an jedem Punkt</translation>
    </message>
    <message>
        <source>Nothing remains in this component.</source>
        <translation>In dieser Komponente verbleibt nichts.</translation>
    </message>
    <message>
        <source>This point</source>
        <translation>Dieser Punkt</translation>
    </message>
    <message>
        <source>All points</source>
        <translation>Alle Punkte</translation>
    </message>
    <message>
        <source>What is drawn</source>
        <translation>Was gezeichnet wird</translation>
    </message>
    <message>
        <source>The remainder over time</source>
        <translation>Der Rest über der Zeit</translation>
    </message>
    <message>
        <source>Search: what neither effects nor noise explain appears here.</source>
        <translation>Suchen: hier erscheint, was weder Effekte noch Rauschen erklären.</translation>
    </message>
    <message>
        <source>Pattern over the points</source>
        <translation>Muster über die Punkte</translation>
    </message>
    <message>
        <source>Over time</source>
        <translation>Über der Zeit</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>Nothing remains beyond the noise.</source>
        <translation>Über das Rauschen hinaus verbleibt nichts.</translation>
    </message>
    <message>
        <source>Beside %1 nothing remains beyond the noise.</source>
        <translation>Außer %1 verbleibt über das Rauschen hinaus nichts.</translation>
    </message>
    <message>
        <source>Nothing can be named: the remainder is %1.</source>
        <translation>Nichts lässt sich benennen: der Rest beträgt %1.</translation>
    </message>
    <message>
        <source>Beside %1 the remainder is %2.</source>
        <translation>Außer %1 beträgt der Rest %2.</translation>
    </message>
    <message>
        <source>%1 / %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>Nothing smooth in time and space remains</source>
        <translation>Nichts verbleibt, das in Zeit und Raum glatt ist</translation>
    </message>
    <message>
        <source>rms of what is smooth in time and space and neither effect nor noise. Evidence that it is more than noise: %1 (2 ln of the odds, clear from %2 on)</source>
        <translation>rms dessen, was in Zeit und Raum glatt und weder Effekt noch Rauschen ist. Evidenz, dass es mehr als Rauschen ist: %1 (2 ln des Chancenverhältnisses, deutlich ab %2)</translation>
    </message>
    <message>
        <source>rms of measured − simulated</source>
        <translation>rms von gemessen − simuliert</translation>
    </message>
    <message>
        <source>rms of what the effects found explain</source>
        <translation>rms dessen, was die gefundenen Effekte erklären</translation>
    </message>
    <message>
        <source>Pattern of %1 over the points / %2</source>
        <translation>Muster von %1 über die Punkte / %2</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>%1 residual / %2</source>
        <translation>Residuum %1 / %2</translation>
    </message>
    <message>
        <source>Remainder of %1 at all points</source>
        <translation>Rest von %1 an allen Punkten</translation>
    </message>
    <message>
        <source>the others</source>
        <translation>die anderen</translation>
    </message>
    <message>
        <source>%1 of %2 over time</source>
        <translation>%1 von %2 über der Zeit</translation>
    </message>
    <message>
        <source>measured − simulated</source>
        <translation>gemessen − simuliert</translation>
    </message>
    <message>
        <source>noise, ± 2 σ</source>
        <translation>Rauschen, ± 2 σ</translation>
    </message>
    <message>
        <source>effects</source>
        <translation>Effekte</translation>
    </message>
    <message>
        <source>remainder</source>
        <translation>Rest</translation>
    </message>
    <message>
        <source>Remainder at the points %1</source>
        <translation>Rest an den Punkten %1</translation>
    </message>
    <message>
        <source>Remainder %1 %2</source>
        <translation>Rest %1 %2</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ReportPage</name>
    <message>
        <source>Open in browser</source>
        <translation>Im Browser öffnen</translation>
    </message>
    <message>
        <source>HTML …</source>
        <translation>HTML …</translation>
    </message>
    <message>
        <source>Save the report as one HTML file</source>
        <translation>Bericht als eine HTML-Datei speichern</translation>
    </message>
    <message>
        <source>PDF …</source>
        <translation>PDF …</translation>
    </message>
    <message>
        <source>Save the report as PDF</source>
        <translation>Bericht als PDF speichern</translation>
    </message>
    <message>
        <source>Write the report</source>
        <translation>Bericht schreiben</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Operator</source>
        <translation>Bediener</translation>
    </message>
    <message>
        <source>Name of the operator</source>
        <translation>Name des Bedieners</translation>
    </message>
    <message>
        <source>Include the discrepancy analysis</source>
        <translation>Diskrepanzanalyse aufnehmen</translation>
    </message>
    <message>
        <source>Search for what the simulation lacks, and report it together with the effects that were added</source>
        <translation>Suchen, was der Simulation fehlt, und zusammen mit den hinzugefügten Effekten berichten</translation>
    </message>
    <message>
        <source>include the discrepancy analysis</source>
        <translation>Diskrepanzanalyse aufnehmen</translation>
    </message>
    <message>
        <source>omit the discrepancy analysis</source>
        <translation>Diskrepanzanalyse auslassen</translation>
    </message>
    <message>
        <source>Sections</source>
        <translation>Abschnitte</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>Abschnitt</translation>
    </message>
    <message>
        <source>Page</source>
        <translation>Seite</translation>
    </message>
    <message>
        <source>Sections of the report</source>
        <translation>Abschnitte des Berichts</translation>
    </message>
    <message>
        <source>Sections appear when the report is written.</source>
        <translation>Abschnitte erscheinen, wenn der Bericht geschrieben ist.</translation>
    </message>
    <message>
        <source>PDF (*.pdf)</source>
        <translation>PDF (*.pdf)</translation>
    </message>
    <message>
        <source>Web page (*.html)</source>
        <translation>Webseite (*.html)</translation>
    </message>
    <message>
        <source>Page %1 of %2</source>
        <translation>Seite %1 von %2</translation>
    </message>
    <message>
        <source>The report will appear here</source>
        <translation>Hier erscheint der Bericht</translation>
    </message>
    <message>
        <source>There is nothing to report yet</source>
        <translation>Es gibt noch nichts zu berichten</translation>
    </message>
    <message>
        <source>Press Write the report: machine, conditions, observations, models with their uncertainties, the discrepancy and where everything came from, on pages to sign.</source>
        <translation>„Bericht schreiben“ drücken: Maschine, Bedingungen, Beobachtungen, Modelle mit ihren Unsicherheiten, die Diskrepanz und die Herkunft von allem, auf Seiten zum Unterschreiben.</translation>
    </message>
    <message>
        <source>Evaluate the captures first (Calibrate).</source>
        <translation>Zuerst die Aufnahmen auswerten (Kalibrieren).</translation>
    </message>
    <message>
        <source>Changed since the report was written: %1.</source>
        <translation>Geändert, seit der Bericht geschrieben wurde: %1.</translation>
    </message>
    <message>
        <source>Write again</source>
        <translation>Erneut schreiben</translation>
    </message>
    <message>
        <source>Opening the report …</source>
        <translation>Der Bericht wird geöffnet …</translation>
    </message>
    <message>
        <source>This report was written by an earlier version</source>
        <translation>Dieser Bericht stammt von einer früheren Version</translation>
    </message>
    <message>
        <source>Write it again to see its pages, or open it in the browser.</source>
        <translation>Erneut schreiben, um seine Seiten zu sehen, oder im Browser öffnen.</translation>
    </message>
    <message>
        <source>The report cannot be shown</source>
        <translation>Der Bericht lässt sich nicht anzeigen</translation>
    </message>
    <message>
        <source>Write it again. %1</source>
        <translation>Erneut schreiben. %1</translation>
    </message>
    <message>
        <source>No browser could be started. The report is here: %1</source>
        <translation>Es ließ sich kein Browser starten. Der Bericht liegt hier: %1</translation>
    </message>
    <message>
        <source>Save the report</source>
        <translation>Bericht speichern</translation>
    </message>
    <message>
        <source>The report has not been written yet; write it first.</source>
        <translation>Der Bericht ist noch nicht geschrieben; zuerst schreiben.</translation>
    </message>
    <message>
        <source>Saving the report</source>
        <translation>Der Bericht wird gespeichert</translation>
    </message>
    <message>
        <source>The report was saved as %1.</source>
        <translation>Der Bericht wurde als %1 gespeichert.</translation>
    </message>
    <message>
        <source>Written %1 by Spindrift %2: %3, %4, %5.</source>
        <translation>Geschrieben %1 von Spindrift %2: %3, %4, %5.</translation>
    </message>
    <message numerus="yes">
        <source>%n pages</source>
        <translation>
            <numerusform>%n Seite</numerusform>
            <numerusform>%n Seiten</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n figures</source>
        <translation>
            <numerusform>%n Bild</numerusform>
            <numerusform>%n Bilder</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n tables</source>
        <translation>
            <numerusform>%n Tabelle</numerusform>
            <numerusform>%n Tabellen</numerusform>
        </translation>
    </message>
    <message>
        <source>change the name of the operator</source>
        <translation>Namen des Bedieners ändern</translation>
    </message>
    <message>
        <source>Name (empty: by hand)</source>
        <translation>Name (leer: von Hand)</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ReportPages</name>
    <message>
        <source>%1 is not a readable PDF file.</source>
        <translation>%1 ist keine lesbare PDF-Datei.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ResolutionCheckPanel</name>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Largest</source>
        <translation>Größte</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Wo</translation>
    </message>
    <message>
        <source>rms</source>
        <translation>rms</translation>
    </message>
    <message>
        <source>Allowed</source>
        <translation>Zulässig</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>The verdict of each axis appears here after the check.</source>
        <translation>Nach der Prüfung erscheint hier das Urteil je Achse.</translation>
    </message>
    <message>
        <source>Needs observations of at least two states; evaluate the captures first.</source>
        <translation>Setzt Beobachtungen von mindestens zwei Zuständen voraus; zuerst die Aufnahmen auswerten.</translation>
    </message>
    <message>
        <source>passed</source>
        <translation>bestanden</translation>
    </message>
    <message>
        <source>not passed</source>
        <translation>nicht bestanden</translation>
    </message>
    <message>
        <source>Changed since this was checked: %1. Check again.</source>
        <translation>Geändert, seit dies geprüft wurde: %1. Erneut prüfen.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ReviewPage</name>
    <message>
        <source>%1 (%2 of %3)</source>
        <translation>%1 (%2 von %3)</translation>
    </message>
    <message>
        <source>This campaign has no observations yet: evaluate its captures first.</source>
        <translation>Diese Kampagne hat noch keine Beobachtungen: zuerst ihre Aufnahmen auswerten.</translation>
    </message>
    <message>
        <source>Pane 1 shows a scan; let it show a state to subtract it.</source>
        <translation>Feld 1 zeigt einen Scan; zum Abziehen muss es einen Zustand zeigen.</translation>
    </message>
    <message>
        <source>Comparing states</source>
        <translation>Zustände werden verglichen</translation>
    </message>
    <message>
        <source>Nothing to show</source>
        <translation>Nichts anzuzeigen</translation>
    </message>
    <message>
        <source>This campaign has no scans.</source>
        <translation>Diese Kampagne hat keine Scans.</translation>
    </message>
    <message>
        <source>%1 was not scanned, or the scan is excluded.</source>
        <translation>%1 wurde nicht gescannt, oder der Scan ist ausgeschlossen.</translation>
    </message>
    <message>
        <source>Comparing scans</source>
        <translation>Scans werden verglichen</translation>
    </message>
    <message>
        <source>Play the states</source>
        <translation>Zustände abspielen</translation>
    </message>
    <message>
        <source>Two panes</source>
        <translation>Zwei Felder</translation>
    </message>
    <message>
        <source>Three</source>
        <translation>Drei</translation>
    </message>
    <message>
        <source>Four</source>
        <translation>Vier</translation>
    </message>
    <message>
        <source>Number of panes</source>
        <translation>Anzahl der Felder</translation>
    </message>
    <message>
        <source>Component</source>
        <translation>Komponente</translation>
    </message>
    <message>
        <source>Between points</source>
        <translation>Zwischen Punkten</translation>
    </message>
    <message>
        <source>A heat map between the points (interpolated with its uncertainty). That of the nine parameters is the model and always shown.</source>
        <translation>Farbkarte zwischen den Punkten (interpoliert mit ihrer Unsicherheit). Die der neun Parameter ist das Modell und wird immer gezeigt.</translation>
    </message>
    <message>
        <source>Arrows</source>
        <translation>Pfeile</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>State shown by panes that follow the slider</source>
        <translation>Zustand der Felder, die dem Schieber folgen</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Points appear with the first evaluated state.</source>
        <translation>Punkte erscheinen mit dem ersten ausgewerteten Zustand.</translation>
    </message>
    <message>
        <source>Along X</source>
        <translation>Entlang X</translation>
    </message>
    <message>
        <source>Along Y</source>
        <translation>Entlang Y</translation>
    </message>
    <message>
        <source>Direction of the section</source>
        <translation>Richtung des Schnitts</translation>
    </message>
    <message>
        <source>Where the section runs</source>
        <translation>Lage des Schnitts</translation>
    </message>
    <message>
        <source>A section will appear here</source>
        <translation>Hier erscheint ein Schnitt</translation>
    </message>
    <message>
        <source>Let a pane show a model, or points near the line.</source>
        <translation>Ein Feld ein Modell oder Punkte nahe der Linie zeigen lassen.</translation>
    </message>
    <message>
        <source>Section</source>
        <translation>Schnitt</translation>
    </message>
    <message>
        <source>There is nothing to compare yet: evaluate the captures first.</source>
        <translation>Es gibt noch nichts zu vergleichen: zuerst die Aufnahmen auswerten.</translation>
    </message>
    <message>
        <source>Go to Calibrate</source>
        <translation>Zu „Kalibrieren“ wechseln</translation>
    </message>
    <message>
        <source>%1 / %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>X / mm</source>
        <translation>X / mm</translation>
    </message>
    <message>
        <source>Y / mm</source>
        <translation>Y / mm</translation>
    </message>
    <message>
        <source>x %1 mm, y %2 mm: %3%4</source>
        <translation>x %1 mm, y %2 mm: %3%4</translation>
    </message>
    <message>
        <source> (extrapolated)</source>
        <translation> (extrapoliert)</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Anhalten</translation>
    </message>
    <message>
        <source>Points compared</source>
        <translation>Verglichene Punkte</translation>
    </message>
    <message>
        <source>Pane %1</source>
        <translation>Feld %1</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ReviewPane</name>
    <message>
        <source>Campaign of pane %1</source>
        <translation>Kampagne von Feld %1</translation>
    </message>
    <message>
        <source>State of pane %1</source>
        <translation>Zustand von Feld %1</translation>
    </message>
    <message>
        <source>What pane %1 shows</source>
        <translation>Was Feld %1 zeigt</translation>
    </message>
    <message>
        <source>Value under the cursor in pane %1</source>
        <translation>Wert unter dem Mauszeiger in Feld %1</translation>
    </message>
    <message>
        <source>At the slider</source>
        <translation>Am Schieber</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>Nine parameters</source>
        <translation>Neun Parameter</translation>
    </message>
    <message>
        <source>Measured − nine parameters</source>
        <translation>Gemessen − neun Parameter</translation>
    </message>
    <message>
        <source>Simulation</source>
        <translation>Simulation</translation>
    </message>
    <message>
        <source>Measured − simulation</source>
        <translation>Gemessen − Simulation</translation>
    </message>
    <message>
        <source>Simulation with effects</source>
        <translation>Simulation mit Effekten</translation>
    </message>
    <message>
        <source>Measured − simulation with effects</source>
        <translation>Gemessen − Simulation mit Effekten</translation>
    </message>
    <message>
        <source>Minus pane 1</source>
        <translation>Minus Feld 1</translation>
    </message>
    <message>
        <source>Scan, change</source>
        <translation>Scan, Änderung</translation>
    </message>
    <message>
        <source>Scan residual</source>
        <translation>Residuum des Scans</translation>
    </message>
    <message>
        <source>dz</source>
        <translation>dz</translation>
    </message>
    <message>
        <source>z</source>
        <translation>z</translation>
    </message>
    <message>
        <source>: the reference itself, height</source>
        <translation>: die Referenz selbst, Höhe</translation>
    </message>
    <message>
        <source>, median |dz| %1 µm</source>
        <translation>, Median |dz| %1 µm</translation>
    </message>
    <message>
        <source>98 % of the points: %1 to %2 %3</source>
        <translation>98 % der Punkte: %1 bis %2 %3</translation>
    </message>
    <message>
        <source>Largest: %1 at %2</source>
        <translation>Größter Wert: %1 bei %2</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ScanCapturePage</name>
    <message>
        <source>Scan every artefact in every cycle, check the clouds, and scan incomplete ones again.</source>
        <translation>Jeden Prüfkörper in jedem Zyklus scannen, die Punktwolken prüfen und unvollständige wiederholen.</translation>
    </message>
    <message>
        <source>Check the scans</source>
        <translation>Scans prüfen</translation>
    </message>
    <message>
        <source>Scans</source>
        <translation>Scans</translation>
    </message>
    <message>
        <source>Scan</source>
        <translation>Scan</translation>
    </message>
    <message>
        <source>At / min</source>
        <translation>Bei / min</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Full / %</source>
        <translation>Voll / %</translation>
    </message>
    <message>
        <source>Scans appear with the first row of captures/scans.csv.</source>
        <translation>Scans erscheinen mit der ersten Zeile von captures/scans.csv.</translation>
    </message>
    <message>
        <source>Exclude …</source>
        <translation>Ausschließen …</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Höhe</translation>
    </message>
    <message>
        <source>Change</source>
        <translation>Änderung</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>Residuum</translation>
    </message>
    <message>
        <source>Colours</source>
        <translation>Farben</translation>
    </message>
    <message>
        <source>Height over the cold scan as it was measured</source>
        <translation>Höhe über dem kalten Scan, wie gemessen</translation>
    </message>
    <message>
        <source>Height over the cold scan after registration</source>
        <translation>Höhe über dem kalten Scan nach der Registrierung</translation>
    </message>
    <message>
        <source>0 used, 1 near an edge, 2 outlier, 3 masked</source>
        <translation>0 verwendet, 1 nahe einer Kante, 2 Ausreißer, 3 maskiert</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Nachher</translation>
    </message>
    <message>
        <source>Side by side</source>
        <translation>Nebeneinander</translation>
    </message>
    <message>
        <source>Before or after cleaning</source>
        <translation>Vor oder nach der Bereinigung</translation>
    </message>
    <message>
        <source>Before or after edge trimming, outlier removal and masking</source>
        <translation>Vor oder nach dem Beschneiden der Kanten, dem Entfernen von Ausreißern und der Maskierung</translation>
    </message>
    <message>
        <source>The cloud will appear here</source>
        <translation>Hier erscheint die Punktwolke</translation>
    </message>
    <message>
        <source>Choose a scan in the list. It is read in the background.</source>
        <translation>Scan in der Liste wählen. Er wird im Hintergrund gelesen.</translation>
    </message>
    <message>
        <source>Along the profile / mm</source>
        <translation>Entlang des Profils / mm</translation>
    </message>
    <message>
        <source>Height / mm</source>
        <translation>Höhe / mm</translation>
    </message>
    <message>
        <source>A profile will appear here</source>
        <translation>Hier erscheint ein Profil</translation>
    </message>
    <message>
        <source>Choose a scan in the list.</source>
        <translation>Scan in der Liste wählen.</translation>
    </message>
    <message>
        <source>Profile</source>
        <translation>Profil</translation>
    </message>
    <message>
        <source>Profile shown</source>
        <translation>Gezeigtes Profil</translation>
    </message>
    <message>
        <source>Changed since: %1. Check the scans again.</source>
        <translation>Geändert seitdem: %1. Scans erneut prüfen.</translation>
    </message>
    <message>
        <source>Show it</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>excluded</source>
        <translation>ausgeschlossen</translation>
    </message>
    <message>
        <source>not checked</source>
        <translation>nicht geprüft</translation>
    </message>
    <message>
        <source>rejected</source>
        <translation>verworfen</translation>
    </message>
    <message>
        <source>incomplete</source>
        <translation>unvollständig</translation>
    </message>
    <message>
        <source>good</source>
        <translation>gut</translation>
    </message>
    <message>
        <source>Excluded: %1.</source>
        <translation>Ausgeschlossen: %1.</translation>
    </message>
    <message>
        <source>A part is masked: %1.</source>
        <translation>Ein Teil ist maskiert: %1.</translation>
    </message>
    <message>
        <source>bad scan</source>
        <translation>unbrauchbarer Scan</translation>
    </message>
    <message>
        <source>Reading %1</source>
        <translation>%1 wird gelesen</translation>
    </message>
    <message>
        <source>This cloud cannot be shown</source>
        <translation>Diese Punktwolke lässt sich nicht darstellen</translation>
    </message>
    <message>
        <source>z</source>
        <translation>z</translation>
    </message>
    <message>
        <source>: the reference itself</source>
        <translation>: die Referenz selbst</translation>
    </message>
    <message>
        <source>cold, warm</source>
        <translation>kalt, warm</translation>
    </message>
    <message>
        <source>: blue the cold scan, red this one</source>
        <translation>: blau der kalte Scan, rot dieser</translation>
    </message>
    <message>
        <source>kind</source>
        <translation>Art</translation>
    </message>
    <message>
        <source>: edge %1, outlier %2, masked %3</source>
        <translation>: Kante %1, Ausreißer %2, maskiert %3</translation>
    </message>
    <message>
        <source>dz</source>
        <translation>dz</translation>
    </message>
    <message>
        <source> over the cold scan, median |dz| %1 µm</source>
        <translation> über dem kalten Scan, Median |dz| %1 µm</translation>
    </message>
    <message>
        <source> after registration, median |dz| %1 µm</source>
        <translation> nach der Registrierung, Median |dz| %1 µm</translation>
    </message>
    <message>
        <source>before</source>
        <translation>vorher</translation>
    </message>
    <message>
        <source>after</source>
        <translation>nachher</translation>
    </message>
    <message>
        <source>Cloud</source>
        <translation>Punktwolke</translation>
    </message>
    <message numerus="yes">
        <source>%n scans are there and none is checked yet. Checking reads every cloud and says which to take again.</source>
        <translation>
            <numerusform>%n Scan ist vorhanden und noch nicht geprüft. Die Prüfung liest jede Punktwolke und sagt, welche zu wiederholen ist.</numerusform>
            <numerusform>%n Scans sind vorhanden, noch keiner ist geprüft. Die Prüfung liest jede Punktwolke und sagt, welche zu wiederholen sind.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All %n scans are complete and can be used.</source>
        <translation>
            <numerusform>Der einzige Scan ist vollständig und verwendbar.</numerusform>
            <numerusform>Alle %n Scans sind vollständig und verwendbar.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n of %1 scans are incomplete or cannot be used (%2). Scan again, or exclude them: the others are evaluated without them.</source>
        <translation>
            <numerusform>%n von %1 Scans ist unvollständig oder unbrauchbar (%2). Erneut scannen oder ausschließen: die übrigen werden ohne ihn ausgewertet.</numerusform>
            <numerusform>%n von %1 Scans sind unvollständig oder unbrauchbar (%2). Erneut scannen oder ausschließen: die übrigen werden ohne sie ausgewertet.</numerusform>
        </translation>
    </message>
    <message>
        <source>%1; not used: %2 and %3.</source>
        <translation>%1; nicht verwendet: %2 und %3.</translation>
    </message>
    <message numerus="yes">
        <source>%n profiles</source>
        <translation>
            <numerusform>%n Profil</numerusform>
            <numerusform>%n Profile</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n points near edges</source>
        <translation>
            <numerusform>%n Punkt nahe Kanten</numerusform>
            <numerusform>%n Punkte nahe Kanten</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n outliers</source>
        <translation>
            <numerusform>%n Ausreißer</numerusform>
            <numerusform>%n Ausreißer</numerusform>
        </translation>
    </message>
    <message>
        <source>Leave what is chosen in the list out of the evaluation; it stays on the disk and can be brought back</source>
        <translation>Lässt das in der Liste Gewählte bei der Auswertung aus; es bleibt auf der Platte und kann zurückgeholt werden</translation>
    </message>
    <message>
        <source>Used</source>
        <translation>Verwendet</translation>
    </message>
    <message>
        <source>Both</source>
        <translation>Beide</translation>
    </message>
    <message>
        <source>Cold and warm, one over the other</source>
        <translation>Kalt und warm übereinander</translation>
    </message>
    <message>
        <source>%1 of %2: y %3 mm</source>
        <translation>%1 von %2: y %3 mm</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ScanMaskBar</name>
    <message>
        <source>Look</source>
        <translation>Ansehen</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pinsel</translation>
    </message>
    <message>
        <source>Rectangle</source>
        <translation>Rechteck</translation>
    </message>
    <message>
        <source>Lasso</source>
        <translation>Lasso</translation>
    </message>
    <message>
        <source>Tool on the scan</source>
        <translation>Werkzeug auf dem Scan</translation>
    </message>
    <message>
        <source>Brush, rectangle and lasso select in the top view</source>
        <translation>Pinsel, Rechteck und Lasso wählen in der Draufsicht</translation>
    </message>
    <message>
        <source>r </source>
        <translation>r </translation>
    </message>
    <message>
        <source>Radius of the brush</source>
        <translation>Radius des Pinsels</translation>
    </message>
    <message>
        <source>Erase</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>Restore</source>
        <translation>Wiederherstellen</translation>
    </message>
    <message>
        <source>What painting does</source>
        <translation>Wirkung des Markierens</translation>
    </message>
    <message>
        <source>dirt or chips on the surface</source>
        <translation>Schmutz oder Späne auf der Fläche</translation>
    </message>
    <message>
        <source>reflection</source>
        <translation>Reflexion</translation>
    </message>
    <message>
        <source>something lay in the way</source>
        <translation>etwas lag im Weg</translation>
    </message>
    <message>
        <source>damaged surface</source>
        <translation>beschädigte Fläche</translation>
    </message>
    <message>
        <source>Reason for the mask</source>
        <translation>Grund der Maskierung</translation>
    </message>
    <message>
        <source>The report will say so</source>
        <translation>Der Grund steht im Bericht</translation>
    </message>
    <message>
        <source>Take all back</source>
        <translation>Alles zurücknehmen</translation>
    </message>
    <message>
        <source>Reason</source>
        <translation>Grund</translation>
    </message>
    <message>
        <source>clear the mask</source>
        <translation>Maskierung aufheben</translation>
    </message>
    <message>
        <source>paint a part of a scan away</source>
        <translation>Teil eines Scans maskieren</translation>
    </message>
    <message>
        <source>take a part of a scan back</source>
        <translation>Teil eines Scans zurückholen</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::SimulationHistory</name>
    <message>
        <source>Measured, simulation before and after</source>
        <translation>Gemessen, Simulation vorher und nachher</translation>
    </message>
    <message>
        <source>Series shown over time</source>
        <translation>Über der Zeit gezeigte Reihe</translation>
    </message>
    <message>
        <source>Measured and simulated over time</source>
        <translation>Gemessen und simuliert über der Zeit</translation>
    </message>
    <message>
        <source>Put something into the simulation: its runs before and after appear here.</source>
        <translation>Etwas in die Simulation einsetzen: hier erscheinen ihre Läufe vorher und nachher.</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>gemessen</translation>
    </message>
    <message>
        <source>simulation before</source>
        <translation>Simulation vorher</translation>
    </message>
    <message>
        <source>simulation after</source>
        <translation>Simulation nachher</translation>
    </message>
    <message>
        <source>held out</source>
        <translation>Validierungsdaten</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>%1 of %2: rms %3 → %4</source>
        <translation>%1 von %2: rms %3 → %4</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::SimulationMaps</name>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Nachher</translation>
    </message>
    <message>
        <source>Measured minus simulation</source>
        <translation>Gemessen minus Simulation</translation>
    </message>
    <message>
        <source>The points of no moment span a plane: there is no map over the table.</source>
        <translation>Zu keinem Zeitpunkt spannen die Punkte eine Ebene auf: es gibt keine Karte über dem Tisch.</translation>
    </message>
    <message>
        <source>Before: largest %1</source>
        <translation>Vorher: größte %1</translation>
    </message>
    <message>
        <source>After: largest %1</source>
        <translation>Nachher: größte %1</translation>
    </message>
    <message>
        <source>%1, measured − simulation at %2 %3</source>
        <translation>%1, gemessen − Simulation bei %2 %3</translation>
    </message>
    <message>
        <source>Initial simulation over the table</source>
        <translation>Ursprüngliche Simulation über dem Tisch</translation>
    </message>
    <message>
        <source>Updated simulation over the table</source>
        <translation>Aktualisierte Simulation über dem Tisch</translation>
    </message>
    <message>
        <source>The map is being worked out.</source>
        <translation>Die Karte wird berechnet.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::SimulationPanel</name>
    <message>
        <source>Simulator</source>
        <translation>Simulator</translation>
    </message>
    <message>
        <source>Take another description of a simulation that can be run</source>
        <translation>Eine andere Beschreibung einer ausführbaren Simulation verwenden</translation>
    </message>
    <message>
        <source>Search with the simulator</source>
        <translation>Mit dem Simulator suchen</translation>
    </message>
    <message>
        <source>Run the simulator and look for what is missing among its parameters as well</source>
        <translation>Den Simulator ausführen und auch unter seinen Parametern nach dem Fehlenden suchen</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Over time</source>
        <translation>Über der Zeit</translation>
    </message>
    <message>
        <source>Over the table</source>
        <translation>Über dem Tisch</translation>
    </message>
    <message>
        <source>What is shown</source>
        <translation>Was gezeigt wird</translation>
    </message>
    <message>
        <source>What was found</source>
        <translation>Befund</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Nachher</translation>
    </message>
    <message>
        <source>Fitted term</source>
        <translation>Angepasster Term</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>Figures before and after</source>
        <translation>Kennzahlen vorher und nachher</translation>
    </message>
    <message>
        <source>Choose the simulator</source>
        <translation>Simulator wählen</translation>
    </message>
    <message>
        <source>Simulator (*.json)</source>
        <translation>Simulator (*.json)</translation>
    </message>
    <message>
        <source>choose the simulator</source>
        <translation>Simulator wählen</translation>
    </message>
    <message>
        <source>Nothing was found that could be put in. Tick a parameter in the column Put in to put it in all the same.</source>
        <translation>Es wurde nichts gefunden, das sich einsetzen ließe. Einen Parameter in der Spalte „Einsetzen“ ankreuzen, um ihn dennoch einzusetzen.</translation>
    </message>
    <message>
        <source>Tick what is to be put in, in the column Put in.</source>
        <translation>In der Spalte „Einsetzen“ ankreuzen, was eingesetzt werden soll.</translation>
    </message>
    <message>
        <source>%1 lies in the campaign folder, which is never written to; choose another place.</source>
        <translation>%1 liegt im Kampagnenordner, in den nie geschrieben wird; einen anderen Ort wählen.</translation>
    </message>
    <message>
        <source>Putting it into the simulation</source>
        <translation>Wird in die Simulation eingesetzt</translation>
    </message>
    <message>
        <source>put %1 into the simulation</source>
        <translation>%1 in die Simulation einsetzen</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>No simulator</source>
        <translation>Kein Simulator</translation>
    </message>
    <message>
        <source>campaign.json names no simulation that can be run (&quot;simulator&quot;: &quot;simulator.json&quot;). Choose one: what is missing is then looked for among its parameters and put into it.</source>
        <translation>campaign.json nennt keine ausführbare Simulation (&quot;simulator&quot;: &quot;simulator.json&quot;). Eine wählen: das Fehlende wird dann unter ihren Parametern gesucht und in sie eingesetzt.</translation>
    </message>
    <message>
        <source>%1%2 %3</source>
        <translation>%1%2 %3</translation>
    </message>
    <message>
        <source>, %1.</source>
        <translation>, %1.</translation>
    </message>
    <message>
        <source>Confidence %1.</source>
        <translation>Konfidenz %1.</translation>
    </message>
    <message>
        <source>These data cannot distinguish it from %1.</source>
        <translation>Diese Daten können ihn nicht von %1 unterscheiden.</translation>
    </message>
    <message>
        <source>or</source>
        <translation>oder</translation>
    </message>
    <message>
        <source>%1 runs of the simulation to search, %2 to fit (%3 s).</source>
        <translation>%1 Läufe der Simulation für die Suche, %2 für die Anpassung (%3 s).</translation>
    </message>
    <message>
        <source>rms, fitted</source>
        <translation>rms, angepasst</translation>
    </message>
    <message>
        <source>rms, held out</source>
        <translation>rms, Validierungsdaten</translation>
    </message>
    <message>
        <source>Peak to peak</source>
        <translation>Spitze-Spitze</translation>
    </message>
    <message>
        <source>Before and after</source>
        <translation>Vorher und nachher</translation>
    </message>
    <message>
        <source>Observations, exclusions, the machine or the effects have changed since the simulator was searched with.</source>
        <translation>Beobachtungen, Ausschlüsse, die Maschine oder die Effekte haben sich seit der Suche mit dem Simulator geändert.</translation>
    </message>
    <message>
        <source>Search again</source>
        <translation>Erneut suchen</translation>
    </message>
    <message>
        <source>Measured and the simulator&apos;s own run agree within the noise.</source>
        <translation>Die Messung und der eigene Lauf des Simulators stimmen innerhalb des Rauschens überein.</translation>
    </message>
    <message>
        <source>Fit the physical parameters on the simulator and write its new version to a new folder; the present one stays as it is</source>
        <translation>Die physikalischen Parameter am Simulator anpassen und seine neue Version in einen neuen Ordner schreiben; die jetzige bleibt, wie sie ist</translation>
    </message>
    <message>
        <source>Search with the simulator, put in what is found and write its new version to a new folder; the present one stays as it is</source>
        <translation>Mit dem Simulator suchen, das Gefundene einsetzen und die neue Version in einen neuen Ordner schreiben; die jetzige bleibt, wie sie ist</translation>
    </message>
    <message>
        <source>Parameters of the simulator</source>
        <translation>Parameter des Simulators</translation>
    </message>
    <message>
        <source>Simulation before and after</source>
        <translation>Simulation vorher und nachher</translation>
    </message>
    <message>
        <source>Initial and updated simulation over time</source>
        <translation>Ursprüngliche und aktualisierte Simulation über der Zeit</translation>
    </message>
    <message>
        <source>Residual / %1</source>
        <translation>Residuum / %1</translation>
    </message>
    <message>
        <source>Choose simulator.json …</source>
        <translation>simulator.json wählen …</translation>
    </message>
    <message>
        <source>Put it into the simulation …</source>
        <translation>In die Simulation einsetzen …</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::SourcesCard</name>
    <message>
        <source>not connected</source>
        <translation>nicht verbunden</translation>
    </message>
    <message>
        <source>connecting</source>
        <translation>Verbindung wird aufgebaut</translation>
    </message>
    <message>
        <source>live</source>
        <translation>live</translation>
    </message>
    <message>
        <source>lost</source>
        <translation>verloren</translation>
    </message>
    <message>
        <source>stopped</source>
        <translation>angehalten</translation>
    </message>
    <message>
        <source>Sources</source>
        <translation>Quellen</translation>
    </message>
    <message>
        <source>Options of the source: user, unit, pattern of its lines, exposure …</source>
        <translation>Optionen der Quelle: Benutzer, Einheit, Muster ihrer Zeilen, Belichtung …</translation>
    </message>
    <message>
        <source>Options of the source</source>
        <translation>Optionen der Quelle</translation>
    </message>
    <message>
        <source>Take the source and its columns away</source>
        <translation>Quelle und ihre Spalten wegnehmen</translation>
    </message>
    <message>
        <source>Remove the source</source>
        <translation>Quelle entfernen</translation>
    </message>
    <message>
        <source>Take over sources and columns from a connections.json</source>
        <translation>Quellen und Spalten aus einer connections.json übernehmen</translation>
    </message>
    <message>
        <source>Open connections.json</source>
        <translation>connections.json öffnen</translation>
    </message>
    <message>
        <source>Source</source>
        <translation>Quelle</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Address</source>
        <translation>Adresse</translation>
    </message>
    <message>
        <source>Enter an address above. Nothing else is contacted.</source>
        <translation>Oben eine Adresse eingeben. Es wird nichts anderes kontaktiert.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::StepList</name>
    <message>
        <source>Steps</source>
        <translation>Schritte</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::SurfacePlot</name>
    <message>
        <source>Surface over position and time</source>
        <translation>Fläche über Position und Zeit</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::TestPartView</name>
    <message>
        <source>Milled test part</source>
        <translation>Gefrästes Prüfwerkstück</translation>
    </message>
    <message>
        <source>Deviations from bore C, magnified %1 ×</source>
        <translation>Abweichungen von Bohrung C, %1-fach vergrößert</translation>
    </message>
    <message>
        <source>No deviation: the part is as it should be</source>
        <translation>Keine Abweichung: Das Werkstück ist, wie es sein soll</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ThermalModelPage</name>
    <message>
        <source>Train a model over time on one part of the log and judge it in free run on another.</source>
        <translation>Ein Modell über der Zeit an einem Teil des Protokolls trainieren und an einem anderen im freien Lauf beurteilen.</translation>
    </message>
    <message>
        <source>Identify the model</source>
        <translation>Modell identifizieren</translation>
    </message>
    <message>
        <source>Output</source>
        <translation>Ausgang</translation>
    </message>
    <message>
        <source>Inputs</source>
        <translation>Eingänge</translation>
    </message>
    <message>
        <source>Residual</source>
        <translation>Residuum</translation>
    </message>
    <message>
        <source>What is drawn</source>
        <translation>Was gezeichnet wird</translation>
    </message>
    <message>
        <source>Test, rms</source>
        <translation>Prüfung, rms</translation>
    </message>
    <message>
        <source>Test, fit</source>
        <translation>Prüfung, Fit</translation>
    </message>
    <message>
        <source>Test, peak to peak</source>
        <translation>Prüfung, Spitze-Spitze</translation>
    </message>
    <message>
        <source>The log will appear here</source>
        <translation>Hier erscheint das Protokoll</translation>
    </message>
    <message>
        <source>It needs a log with at least one displacement (a column ending in _um or _urad).</source>
        <translation>Es braucht ein Protokoll mit mindestens einer Verschiebung (Spalte, die auf _um oder _urad endet).</translation>
    </message>
    <message>
        <source>Measured output</source>
        <translation>Gemessener Ausgang</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>How the model is found</source>
        <translation>Wie das Modell gefunden wird</translation>
    </message>
    <message>
        <source>All time constants</source>
        <translation>Alle Zeitkonstanten</translation>
    </message>
    <message>
        <source>ARX</source>
        <translation>ARX</translation>
    </message>
    <message>
        <source>Output error</source>
        <translation>Ausgangsfehler</translation>
    </message>
    <message>
        <source>Training from</source>
        <translation>Training ab</translation>
    </message>
    <message>
        <source>Training to</source>
        <translation>Training bis</translation>
    </message>
    <message>
        <source>Test from</source>
        <translation>Prüfung ab</translation>
    </message>
    <message>
        <source>Test to</source>
        <translation>Prüfung bis</translation>
    </message>
    <message>
        <source>Train</source>
        <translation>Training</translation>
    </message>
    <message>
        <source>Test</source>
        <translation>Prüfung</translation>
    </message>
    <message>
        <source>choose the output</source>
        <translation>Ausgang wählen</translation>
    </message>
    <message>
        <source>choose the method</source>
        <translation>Verfahren wählen</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Train rms</source>
        <translation>Training, rms</translation>
    </message>
    <message>
        <source>Test rms</source>
        <translation>Prüfung, rms</translation>
    </message>
    <message>
        <source>Fit / %</source>
        <translation>Fit / %</translation>
    </message>
    <message>
        <source>Comparison</source>
        <translation>Vergleich</translation>
    </message>
    <message>
        <source>Compare</source>
        <translation>Vergleichen</translation>
    </message>
    <message>
        <source>Input</source>
        <translation>Eingang</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Part, rms</source>
        <translation>Anteil, rms</translation>
    </message>
    <message>
        <source>Without / %</source>
        <translation>Ohne / %</translation>
    </message>
    <message>
        <source>The signals of the log appear here.</source>
        <translation>Hier erscheinen die Signale des Protokolls.</translation>
    </message>
    <message>
        <source>Input whose step response is shown</source>
        <translation>Eingang, dessen Sprungantwort gezeigt wird</translation>
    </message>
    <message>
        <source>Step responses will appear here</source>
        <translation>Hier erscheinen die Sprungantworten</translation>
    </message>
    <message>
        <source>Identify the model: the answer to a step of each input with its uncertainty.</source>
        <translation>Modell identifizieren: die Antwort auf einen Sprung jedes Eingangs mit ihrer Unsicherheit.</translation>
    </message>
    <message>
        <source>Step</source>
        <translation>Schritt</translation>
    </message>
    <message>
        <source>Time constant</source>
        <translation>Zeitkonstante</translation>
    </message>
    <message>
        <source>Pole / 1/h</source>
        <translation>Pol / 1/h</translation>
    </message>
    <message>
        <source>Gain</source>
        <translation>Verstärkung</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Time constants</source>
        <translation>Zeitkonstanten</translation>
    </message>
    <message>
        <source>Poles as time constants with their gains appear after the identification.</source>
        <translation>Nach der Identifikation erscheinen hier die Pole als Zeitkonstanten mit ihren Verstärkungen.</translation>
    </message>
    <message>
        <source>Lag / min</source>
        <translation>Zeitversatz / min</translation>
    </message>
    <message>
        <source>Autocorrelation</source>
        <translation>Autokorrelation</translation>
    </message>
    <message>
        <source>The autocorrelation of the residual will appear here</source>
        <translation>Hier erscheint die Autokorrelation des Residuums</translation>
    </message>
    <message>
        <source>Identify the model: its residual in training should be white noise.</source>
        <translation>Modell identifizieren: sein Residuum im Training sollte weißes Rauschen sein.</translation>
    </message>
    <message>
        <source>Largest correlation</source>
        <translation>Größte Korrelation</translation>
    </message>
    <message>
        <source>Limit, 99 %</source>
        <translation>Grenze, 99 %</translation>
    </message>
    <message>
        <source>Residual against inputs</source>
        <translation>Residuum gegen Eingänge</translation>
    </message>
    <message>
        <source>How the residual depends on each input appears here.</source>
        <translation>Hier erscheint, wie das Residuum von jedem Eingang abhängt.</translation>
    </message>
    <message>
        <source>Residuals</source>
        <translation>Residuen</translation>
    </message>
    <message>
        <source>Updates</source>
        <translation>Nachführung</translation>
    </message>
    <message>
        <source>choose the inputs</source>
        <translation>Eingänge wählen</translation>
    </message>
    <message>
        <source>training range</source>
        <translation>Trainingsbereich</translation>
    </message>
    <message>
        <source>test range</source>
        <translation>Prüfbereich</translation>
    </message>
    <message>
        <source>Reading the log</source>
        <translation>Protokoll wird gelesen</translation>
    </message>
    <message>
        <source>Reading the model</source>
        <translation>Modell wird gelesen</translation>
    </message>
    <message>
        <source>Changed since: %1. Identify the model again.</source>
        <translation>Geändert seitdem: %1. Modell erneut identifizieren.</translation>
    </message>
    <message>
        <source>Drag the edges of the training and the test range, then press Identify the model. Nothing measured in the test range is used.</source>
        <translation>Die Ränder von Trainings- und Prüfbereich ziehen, dann „Modell identifizieren“ drücken. Nichts im Prüfbereich Gemessenes wird verwendet.</translation>
    </message>
    <message>
        <source>In the test range the model is no better than the baselines. Train on a longer range with more excitation, or choose other inputs.</source>
        <translation>Im Prüfbereich ist das Modell nicht besser als die Vergleichsmodelle. An einem längeren Bereich mit mehr Anregung trainieren oder andere Eingänge wählen.</translation>
    </message>
    <message>
        <source>Free run over the test range: rms %1 %2, without a model %3 %2.</source>
        <translation>Freier Lauf über den Prüfbereich: rms %1 %2, ohne Modell %3 %2.</translation>
    </message>
    <message>
        <source>Measured at few rows only: ARX and output error need a value at nearly every one</source>
        <translation>Nur an wenigen Zeilen gemessen: ARX und Ausgangsfehler brauchen fast an jeder einen Wert</translation>
    </message>
    <message>
        <source>kept</source>
        <translation>beibehalten</translation>
    </message>
    <message>
        <source>dropped</source>
        <translation>verworfen</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>Predicted, ± 2 uncertainties</source>
        <translation>Vorhergesagt, ± 2 Unsicherheiten</translation>
    </message>
    <message>
        <source>Time / h</source>
        <translation>Zeit / h</translation>
    </message>
    <message>
        <source>%1 / %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>%1 (%2 … %3)</source>
        <translation>%1 (%2 … %3)</translation>
    </message>
    <message>
        <source>Part of its range</source>
        <translation>Teil seiner Spanne</translation>
    </message>
    <message>
        <source>Measured minus predicted</source>
        <translation>Gemessen minus vorhergesagt</translation>
    </message>
    <message>
        <source>Residual / %1</source>
        <translation>Residuum / %1</translation>
    </message>
    <message>
        <source>Training</source>
        <translation>Training</translation>
    </message>
    <message>
        <source>This model</source>
        <translation>Dieses Modell</translation>
    </message>
    <message>
        <source>free run, inputs: %1</source>
        <translation>freier Lauf, Eingänge: %1</translation>
    </message>
    <message>
        <source>Step of %1 by %2, 95 % interval</source>
        <translation>Sprung von %1 um %2, 95-%-Intervall</translation>
    </message>
    <message>
        <source>Time after a step of %1 by %2 / h</source>
        <translation>Zeit nach einem Sprung von %1 um %2 / h</translation>
    </message>
    <message>
        <source>Response / %1</source>
        <translation>Antwort / %1</translation>
    </message>
    <message>
        <source>63 % after %1</source>
        <translation>63 % nach %1</translation>
    </message>
    <message>
        <source>at once</source>
        <translation>sofort</translation>
    </message>
    <message>
        <source>static gain</source>
        <translation>statische Verstärkung</translation>
    </message>
    <message>
        <source>The residual of the ARX equation is not white: this value is biased and its interval does not hold.</source>
        <translation>Das Residuum der ARX-Gleichung ist nicht weiß: dieser Wert ist verzerrt, sein Intervall gilt nicht.</translation>
    </message>
    <message>
        <source>pole</source>
        <translation>Pol</translation>
    </message>
    <message>
        <source>%1 at %2</source>
        <translation>%1 bei %2</translation>
    </message>
    <message>
        <source>p &lt; 0.001</source>
        <translation>p &lt; 0,001</translation>
    </message>
    <message>
        <source>p = %1</source>
        <translation>p = %1</translation>
    </message>
    <message>
        <source>The residual is not white (%1): something slow is left, a drift or a missing input. The uncertainty of the prediction carries it.</source>
        <translation>Das Residuum ist nicht weiß (%1): etwas Langsames bleibt übrig, eine Drift oder ein fehlender Eingang. Die Unsicherheit der Vorhersage enthält es.</translation>
    </message>
    <message>
        <source>The residual looks like white noise (%1).</source>
        <translation>Das Residuum sieht wie weißes Rauschen aus (%1).</translation>
    </message>
    <message>
        <source>%1 at %2 min</source>
        <translation>%1 bei %2 min</translation>
    </message>
    <message>
        <source>Model over time</source>
        <translation>Modell über der Zeit</translation>
    </message>
    <message>
        <source>Comparison of models</source>
        <translation>Vergleich der Modelle</translation>
    </message>
    <message>
        <source>Step response</source>
        <translation>Sprungantwort</translation>
    </message>
    <message>
        <source>Autocorrelation of the residual</source>
        <translation>Autokorrelation des Residuums</translation>
    </message>
    <message>
        <source>Thermal model</source>
        <translation>Thermisches Modell</translation>
    </message>
    <message>
        <source>Prediction</source>
        <translation>Vorhersage</translation>
    </message>
    <message>
        <source>After the identification the model is compared with no model and with a static regression.</source>
        <translation>Nach der Identifikation steht das Modell neben „ohne Modell“ und einer statischen Regression.</translation>
    </message>
    <message>
        <source>Peak to peak</source>
        <translation>Spitze-Spitze</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::TouchCapturePage</name>
    <message>
        <source>Cycle %1</source>
        <translation>Zyklus %1</translation>
    </message>
    <message>
        <source>, table at %1°</source>
        <translation>, Tisch bei %1°</translation>
    </message>
    <message>
        <source>The position of the first ball is not known. Probe it once by hand; then the program can be planned.</source>
        <translation>Die Position der ersten Kugel ist nicht bekannt. Sie einmal von Hand antasten; dann lässt sich das Programm planen.</translation>
    </message>
    <message>
        <source>Planning the measuring cycle</source>
        <translation>Messzyklus wird geplant</translation>
    </message>
    <message>
        <source>No program: %1</source>
        <translation>Kein Programm: %1</translation>
    </message>
    <message>
        <source>Program not exported, issues found by the check: %1. Line %2: %3</source>
        <translation>Programm nicht ausgegeben, Beanstandungen der Prüfung: %1. Zeile %2: %3</translation>
    </message>
    <message>
        <source>Cycles</source>
        <translation>Zyklen</translation>
    </message>
    <message>
        <source>Touches</source>
        <translation>Antastungen</translation>
    </message>
    <message>
        <source>Measuring cycle</source>
        <translation>Messzyklus</translation>
    </message>
    <message>
        <source>Measuring program</source>
        <translation>Messprogramm</translation>
    </message>
    <message>
        <source>Template of what it prints</source>
        <translation>Vorlage des Gedruckten</translation>
    </message>
    <message>
        <source>plausible</source>
        <translation>plausibel</translation>
    </message>
    <message>
        <source>rejected</source>
        <translation>verworfen</translation>
    </message>
    <message>
        <source>missing</source>
        <translation>fehlt</translation>
    </message>
    <message>
        <source>excluded</source>
        <translation>ausgeschlossen</translation>
    </message>
    <message>
        <source>slanted</source>
        <translation>schräg</translation>
    </message>
    <message>
        <source>Run the measuring cycle on the machine, check every touch, and take missing ones again.</source>
        <translation>Messzyklus an der Maschine ausführen, jede Antastung prüfen und fehlende wiederholen.</translation>
    </message>
    <message>
        <source>Check the touches</source>
        <translation>Antastungen prüfen</translation>
    </message>
    <message>
        <source>Cycle</source>
        <translation>Zyklus</translation>
    </message>
    <message>
        <source>Time / min</source>
        <translation>Zeit / min</translation>
    </message>
    <message>
        <source>Good</source>
        <translation>Gut</translation>
    </message>
    <message>
        <source>Rejected</source>
        <translation>Verworfen</translation>
    </message>
    <message>
        <source>Missing</source>
        <translation>Fehlend</translation>
    </message>
    <message>
        <source>Cycles appear with the first touch.</source>
        <translation>Zyklen erscheinen mit der ersten Antastung.</translation>
    </message>
    <message>
        <source>Touches of the cycle</source>
        <translation>Antastungen des Zyklus</translation>
    </message>
    <message>
        <source>State of the touches</source>
        <translation>Zustand der Antastungen</translation>
    </message>
    <message>
        <source>All states</source>
        <translation>Alle Zustände</translation>
    </message>
    <message>
        <source>Plausible</source>
        <translation>Plausibel</translation>
    </message>
    <message>
        <source>Excluded</source>
        <translation>Ausgeschlossen</translation>
    </message>
    <message>
        <source>Touch</source>
        <translation>Antastung</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Residual / µm</source>
        <translation>Residuum / µm</translation>
    </message>
    <message>
        <source>Station</source>
        <translation>Station</translation>
    </message>
    <message>
        <source>Towards</source>
        <translation>In Richtung</translation>
    </message>
    <message>
        <source>No touch of this cycle has this state.</source>
        <translation>Keine Antastung dieses Zyklus hat diesen Zustand.</translation>
    </message>
    <message>
        <source>Exclude …</source>
        <translation>Ausschließen …</translation>
    </message>
    <message>
        <source>Leave the chosen touches out; they stay on the disk and can be brought back</source>
        <translation>Gewählte Antastungen auslassen; sie bleiben gespeichert und können zurückgeholt werden</translation>
    </message>
    <message>
        <source>Dialect of the control</source>
        <translation>Dialekt der Steuerung</translation>
    </message>
    <message>
        <source>Fanuc</source>
        <translation>Fanuc</translation>
    </message>
    <message>
        <source>Siemens</source>
        <translation>Siemens</translation>
    </message>
    <message>
        <source>Heidenhain</source>
        <translation>Heidenhain</translation>
    </message>
    <message>
        <source>Generic</source>
        <translation>Allgemein</translation>
    </message>
    <message>
        <source>Program</source>
        <translation>Programm</translation>
    </message>
    <message>
        <source>Write the measuring program for this control, read it back and check it</source>
        <translation>Messprogramm für diese Steuerung schreiben, zurücklesen und prüfen</translation>
    </message>
    <message>
        <source>The measuring cycle will appear here</source>
        <translation>Hier erscheint der Messzyklus</translation>
    </message>
    <message>
        <source>It needs an artefact and a stylus in the machine description (step Machine).</source>
        <translation>Er braucht einen Prüfkörper und einen Tastereinsatz in der Maschinenbeschreibung (Schritt „Maschine“).</translation>
    </message>
    <message>
        <source>Path</source>
        <translation>Bahn</translation>
    </message>
    <message>
        <source>Machine and travel</source>
        <translation>Maschine und Verfahrwege</translation>
    </message>
    <message>
        <source>Reading the touches</source>
        <translation>Antastungen werden gelesen</translation>
    </message>
    <message>
        <source>The campaign lists no touches yet.</source>
        <translation>Die Kampagne führt noch keine Antastungen auf.</translation>
    </message>
    <message>
        <source>Changed since: %1. Check the touches again.</source>
        <translation>Geändert seitdem: %1. Antastungen erneut prüfen.</translation>
    </message>
    <message>
        <source>Show it</source>
        <translation>Anzeigen</translation>
    </message>
    <message>
        <source>Rejected touches: %1, missing: %2 (%3). Take them again while the machine is in this state; the others are evaluated without them.</source>
        <translation>Verworfene Antastungen: %1, fehlende: %2 (%3). Wiederholen, solange die Maschine in diesem Zustand ist; die übrigen werden ohne sie ausgewertet.</translation>
    </message>
    <message>
        <source>not checked</source>
        <translation>nicht geprüft</translation>
    </message>
    <message>
        <source>%1 · %2 at x %3, y %4, z %5 mm</source>
        <translation>%1 · %2 bei x %3, y %4, z %5 mm</translation>
    </message>
    <message>
        <source>%1 · %2</source>
        <translation>%1 · %2</translation>
    </message>
    <message>
        <source>Excluded: %1.</source>
        <translation>Ausgeschlossen: %1.</translation>
    </message>
    <message>
        <source>bad touch</source>
        <translation>unbrauchbare Antastung</translation>
    </message>
    <message numerus="yes">
        <source>%n touches are there and none is checked yet. Checking compares every touch with all others and says which to take again.</source>
        <translation>
            <numerusform>%n Antastung ist vorhanden und noch nicht geprüft. Die Prüfung vergleicht jede Antastung mit allen anderen und sagt, welche zu wiederholen ist.</numerusform>
            <numerusform>%n Antastungen sind vorhanden, noch keine ist geprüft. Die Prüfung vergleicht jede Antastung mit allen anderen und sagt, welche zu wiederholen sind.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All %n touches are plausible and none is missing.</source>
        <translation>
            <numerusform>Die einzige Antastung ist plausibel, und keine fehlt.</numerusform>
            <numerusform>Alle %n Antastungen sind plausibel, und keine fehlt.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>All %n touches are plausible. Whether one is missing shows when a second cycle is there to compare with.</source>
        <translation>
            <numerusform>Die einzige Antastung ist plausibel. Ob eine fehlt, zeigt sich, wenn ein zweiter Zyklus zum Vergleich vorliegt.</numerusform>
            <numerusform>Alle %n Antastungen sind plausibel. Ob eine fehlt, zeigt sich, wenn ein zweiter Zyklus zum Vergleich vorliegt.</numerusform>
        </translation>
    </message>
    <message>
        <source>The machine has changed since the programme was planned. Plan it again.</source>
        <translation>Die Maschine hat sich geändert, seit das Programm geplant wurde. Es neu planen.</translation>
    </message>
    <message numerus="yes">
        <source>Program checked: %n touches in %1 moves inside the travel, none through the artefact, a retract after each, safe height %2 mm. Export (Ctrl+E) writes it.</source>
        <translation>
            <numerusform>Programm geprüft: %n Antastung in %1 Bewegungen innerhalb der Verfahrwege, nicht durch den Prüfkörper, danach ein Rückzug, sichere Höhe %2 mm. „Exportieren“ (Strg+E) schreibt es.</numerusform>
            <numerusform>Programm geprüft: %n Antastungen in %1 Bewegungen innerhalb der Verfahrwege, keine durch den Prüfkörper, nach jeder ein Rückzug, sichere Höhe %2 mm. „Exportieren“ (Strg+E) schreibt es.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n touches from below are left out, where the stem of a ball may be.</source>
        <translation>
            <numerusform>%n Antastung von unten ist ausgelassen, wo der Stift einer Kugel sein kann.</numerusform>
            <numerusform>%n Antastungen von unten sind ausgelassen, wo der Stift einer Kugel sein kann.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>spindrift::gui::TouchEvaluationPage</name>
    <message>
        <source>Turn touches into features and deviations, and see whether probe and artefact can be trusted.</source>
        <translation>Antastungen in Merkmale und Abweichungen umsetzen und sehen, ob Messtaster und Prüfkörper vertrauenswürdig sind.</translation>
    </message>
    <message>
        <source>Evaluate the touches</source>
        <translation>Antastungen auswerten</translation>
    </message>
    <message>
        <source>Touches used</source>
        <translation>Verwendete Antastungen</translation>
    </message>
    <message>
        <source>Touch noise</source>
        <translation>Antastrauschen</translation>
    </message>
    <message>
        <source>Largest length error</source>
        <translation>Größte Längenabweichung</translation>
    </message>
    <message>
        <source>Probe</source>
        <translation>Messtaster</translation>
    </message>
    <message>
        <source>Features</source>
        <translation>Merkmale</translation>
    </message>
    <message>
        <source>Cycle whose features are listed</source>
        <translation>Zyklus, dessen Merkmale aufgeführt sind</translation>
    </message>
    <message>
        <source>Feature</source>
        <translation>Merkmal</translation>
    </message>
    <message>
        <source>x / mm</source>
        <translation>x / mm</translation>
    </message>
    <message>
        <source>y / mm</source>
        <translation>y / mm</translation>
    </message>
    <message>
        <source>z / mm</source>
        <translation>z / mm</translation>
    </message>
    <message>
        <source>± / µm</source>
        <translation>± / µm</translation>
    </message>
    <message>
        <source>D / mm</source>
        <translation>D / mm</translation>
    </message>
    <message>
        <source>Form / µm</source>
        <translation>Form / µm</translation>
    </message>
    <message>
        <source>Centre, diameter and form of every hole or ball appear after the evaluation.</source>
        <translation>Nach der Auswertung erscheinen hier Zentrum, Durchmesser und Form jedes Lochs oder jeder Kugel.</translation>
    </message>
    <message>
        <source>Touch</source>
        <translation>Antastung</translation>
    </message>
    <message>
        <source>Why it was left out</source>
        <translation>Grund des Auslassens</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>Ausgelassen</translation>
    </message>
    <message>
        <source>Nothing was left out.</source>
        <translation>Es wurde nichts ausgelassen.</translation>
    </message>
    <message>
        <source>Lengths</source>
        <translation>Längen</translation>
    </message>
    <message>
        <source>Distances and straightness appear after the evaluation.</source>
        <translation>Nach der Auswertung erscheinen hier Abstände und Geradheit.</translation>
    </message>
    <message>
        <source>Parameter</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>Repeatability, k = 2</source>
        <translation>Wiederholpräzision, k = 2</translation>
    </message>
    <message>
        <source>From touch noise</source>
        <translation>Aus dem Antastrauschen</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Repeatability</source>
        <translation>Wiederholpräzision</translation>
    </message>
    <message>
        <source>Repeatability requires at least 18 cycles.</source>
        <translation>Die Wiederholpräzision erfordert mindestens 18 Zyklen.</translation>
    </message>
    <message>
        <source>Stylus</source>
        <translation>Tastereinsatz</translation>
    </message>
    <message>
        <source>Sphere</source>
        <translation>Kugel</translation>
    </message>
    <message>
        <source>Radius / mm</source>
        <translation>Radius / mm</translation>
    </message>
    <message>
        <source>Pre-travel / µm</source>
        <translation>Vorlauf / µm</translation>
    </message>
    <message>
        <source>Repeats / µm</source>
        <translation>Wiederholung / µm</translation>
    </message>
    <message>
        <source>Step / µm</source>
        <translation>Sprung / µm</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Health of the probe</source>
        <translation>Zustand des Messtasters</translation>
    </message>
    <message>
        <source>Touch a sphere from at least five directions to qualify the styli.</source>
        <translation>Zum Einmessen der Tastereinsätze eine Kugel aus mindestens fünf Richtungen antasten.</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referenz</translation>
    </message>
    <message>
        <source>Deviation over time</source>
        <translation>Abweichung über der Zeit</translation>
    </message>
    <message>
        <source>Feature whose deviations are shown</source>
        <translation>Merkmal, dessen Abweichungen gezeigt werden</translation>
    </message>
    <message>
        <source>Time / h</source>
        <translation>Zeit / h</translation>
    </message>
    <message>
        <source>Deviation / µm</source>
        <translation>Abweichung / µm</translation>
    </message>
    <message>
        <source>Deviations will appear here</source>
        <translation>Hier erscheinen die Abweichungen</translation>
    </message>
    <message>
        <source>Evaluate the touches: every feature is compared with the first cycle.</source>
        <translation>Antastungen auswerten: jedes Merkmal wird mit dem ersten Zyklus verglichen.</translation>
    </message>
    <message>
        <source>Reading the evaluation</source>
        <translation>Auswertung wird gelesen</translation>
    </message>
    <message>
        <source>Press Evaluate the touches. Those that cannot be used are listed with the reason, the others are evaluated.</source>
        <translation>„Antastungen auswerten“ drücken. Unbrauchbare werden mit Grund aufgeführt, die übrigen ausgewertet.</translation>
    </message>
    <message>
        <source>Changed since this was evaluated: %1. Evaluate again.</source>
        <translation>Geändert seit der Auswertung: %1. Erneut auswerten.</translation>
    </message>
    <message>
        <source> And %1 more.</source>
        <translation> Und %1 weitere.</translation>
    </message>
    <message>
        <source>This page shows %1. The other artefacts are evaluated too: their deviations stand in the observations and in the report.</source>
        <translation>Diese Seite zeigt %1. Die anderen Prüfkörper werden ebenfalls ausgewertet: ihre Abweichungen stehen in den Beobachtungen und im Bericht.</translation>
    </message>
    <message>
        <source>none left out</source>
        <translation>keine ausgelassen</translation>
    </message>
    <message>
        <source>%1 left out</source>
        <translation>%1 ausgelassen</translation>
    </message>
    <message>
        <source>across the surface, one standard deviation</source>
        <translation>quer zur Fläche, eine Standardabweichung</translation>
    </message>
    <message>
        <source>%1 µm along the axis</source>
        <translation>%1 µm entlang der Achse</translation>
    </message>
    <message>
        <source>deviation of a hole from the straight line, all cycles</source>
        <translation>Abweichung eines Lochs von der Geraden, alle Zyklen</translation>
    </message>
    <message>
        <source>of a distance between balls</source>
        <translation>eines Abstands zwischen Kugeln</translation>
    </message>
    <message>
        <source>not judged</source>
        <translation>nicht beurteilt</translation>
    </message>
    <message>
        <source>needs touches on a sphere</source>
        <translation>setzt Antastungen an einer Kugel voraus</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
    <message>
        <source>stylus-sphere pairs repeat</source>
        <translation>Paare aus Tastereinsatz und Kugel wiederholen sich</translation>
    </message>
    <message>
        <source>The largest standard uncertainty of x, y and z</source>
        <translation>Die größte Standardunsicherheit von x, y und z</translation>
    </message>
    <message>
        <source>excluded: %1</source>
        <translation>ausgeschlossen: %1</translation>
    </message>
    <message>
        <source>Left out (%1)</source>
        <translation>Ausgelassen (%1)</translation>
    </message>
    <message>
        <source>Hole</source>
        <translation>Loch</translation>
    </message>
    <message>
        <source>rms / µm</source>
        <translation>rms / µm</translation>
    </message>
    <message>
        <source>Largest / µm</source>
        <translation>Größte / µm</translation>
    </message>
    <message>
        <source>In cycle</source>
        <translation>Im Zyklus</translation>
    </message>
    <message>
        <source>Noise / µm</source>
        <translation>Rauschen / µm</translation>
    </message>
    <message>
        <source>Straight line</source>
        <translation>Gerade</translation>
    </message>
    <message>
        <source>Balls</source>
        <translation>Kugeln</translation>
    </message>
    <message>
        <source>Cycle</source>
        <translation>Zyklus</translation>
    </message>
    <message>
        <source>Error / µm</source>
        <translation>Abweichung / µm</translation>
    </message>
    <message>
        <source>Certified / mm</source>
        <translation>Zertifiziert / mm</translation>
    </message>
    <message>
        <source>Distances</source>
        <translation>Abstände</translation>
    </message>
    <message>
        <source>within two uncertainties</source>
        <translation>innerhalb zweier Unsicherheiten</translation>
    </message>
    <message>
        <source>the machine differs</source>
        <translation>die Maschine weicht ab</translation>
    </message>
    <message>
        <source>Drift slower than nine cycles is removed; the residual scatter is the repeatability of one cycle.</source>
        <translation>Drift, die langsamer ist als neun Zyklen, ist entfernt; die Reststreuung (Residuum) ist die Wiederholpräzision eines Zyklus.</translation>
    </message>
    <message>
        <source>loose</source>
        <translation>locker</translation>
    </message>
    <message>
        <source>loose or still warming up</source>
        <translation>locker oder noch nicht warm</translation>
    </message>
    <message>
        <source>healthy</source>
        <translation>in Ordnung</translation>
    </message>
    <message>
        <source>to be checked</source>
        <translation>zu prüfen</translation>
    </message>
    <message>
        <source>%1 on %2: %3</source>
        <translation>%1 an %2: %3</translation>
    </message>
    <message>
        <source>All styli repeat as well as an intact probe does.</source>
        <translation>Alle Tastereinsätze wiederholen so gut wie ein intakter Messtaster.</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>Deviation of %1 / µm</source>
        <translation>Abweichung von %1 / µm</translation>
    </message>
    <message>
        <source>Touches left out</source>
        <translation>Ausgelassene Antastungen</translation>
    </message>
    <message>
        <source>Comparison</source>
        <translation>Vergleich</translation>
    </message>
    <message>
        <source>Nothing to compare with: balls need three styli, a bar of holes its certificate or its expansion coefficient with a thermometer.</source>
        <translation>Nichts zu vergleichen: Kugeln brauchen drei Tastereinsätze, eine Lochleiste ihren Kalibrierschein oder ihren Ausdehnungskoeffizienten mit Thermometer.</translation>
    </message>
    <message>
        <source>Certificate</source>
        <translation>Kalibrierschein</translation>
    </message>
    <message>
        <source>Bar / °C</source>
        <translation>Leiste / °C</translation>
    </message>
    <message>
        <source>%1 against certificate / (µm/m)</source>
        <translation>%1 gegen Kalibrierschein / (µm/m)</translation>
    </message>
    <message>
        <source>Growth, coefficient × temperature / (µm/m)</source>
        <translation>Ausdehnung, Koeffizient × Temperatur / (µm/m)</translation>
    </message>
    <message>
        <source>Growth, touches / (µm/m)</source>
        <translation>Ausdehnung, Antastungen / (µm/m)</translation>
    </message>
    <message>
        <source>EME combines touches with expansion coefficient and temperature by their uncertainties; the certificate counts in EME and EXX.</source>
        <translation>EME verbindet Antastungen mit Ausdehnungskoeffizient und Temperatur nach ihren Unsicherheiten; der Kalibrierschein zählt in EME und EXX.</translation>
    </message>
    <message>
        <source>EME rests on the touches: coefficient and temperature are combined with them only where both state their uncertainty and do not contradict them.</source>
        <translation>EME beruht auf den Antastungen: Koeffizient und Temperatur werden nur dann mit ihnen verbunden, wenn beide ihre Unsicherheit angeben und ihnen nicht widersprechen.</translation>
    </message>
    <message>
        <source>Closed forms</source>
        <translation>Geschlossene Lösung</translation>
    </message>
    <message>
        <source>Ball</source>
        <translation>Kugel</translation>
    </message>
    <message>
        <source>Closed forms X, Y, Z / µrad</source>
        <translation>Geschlossene Lösung X, Y, Z / µrad</translation>
    </message>
    <message>
        <source>Joint evaluation X, Y, Z / µrad</source>
        <translation>Gemeinsame Auswertung X, Y, Z / µrad</translation>
    </message>
    <message>
        <source>Stylus 0 moved / µm</source>
        <translation>Weg von Tastereinsatz 0 / µm</translation>
    </message>
    <message>
        <source>Joint drift / µm</source>
        <translation>Drift, gemeinsam / µm</translation>
    </message>
    <message>
        <source>The closed forms take every translation for a rotation of the head: here they are off by up to %1 µrad. They are shown for comparison and not used.</source>
        <translation>Die geschlossenen Lösungen halten jede Verschiebung für eine Drehung des Kopfes: Hier weichen sie bis zu %1 µrad ab. Sie stehen zum Vergleich da und werden nicht verwendet.</translation>
    </message>
    <message>
        <source>Deviations found: %1.</source>
        <translation>Abweichungen ermittelt: %1.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::UpdatePanel</name>
    <message>
        <source>How a measurement updates the model</source>
        <translation>Wie eine Messung das Modell nachführt</translation>
    </message>
    <message>
        <source>Gain and offset</source>
        <translation>Verstärkung und Versatz</translation>
    </message>
    <message>
        <source>Gain: measured / simulated</source>
        <translation>Verstärkung: gemessen / simuliert</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>every</source>
        <translation>alle</translation>
    </message>
    <message>
        <source>Time between two on-machine measurements</source>
        <translation>Zeit zwischen zwei Messungen auf der Maschine</translation>
    </message>
    <message>
        <source> min</source>
        <translation> min</translation>
    </message>
    <message>
        <source>Run the updates</source>
        <translation>Nachführung ausführen</translation>
    </message>
    <message>
        <source>Over time</source>
        <translation>Über der Zeit</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Fit</translation>
    </message>
    <message>
        <source>Peak to peak</source>
        <translation>Spitze-Spitze</translation>
    </message>
    <message>
        <source>What is drawn of the updates</source>
        <translation>Was von der Nachführung gezeichnet wird</translation>
    </message>
    <message>
        <source>The updated model will appear here</source>
        <translation>Hier erscheint das nachgeführte Modell</translation>
    </message>
    <message>
        <source>Identify the model, then run the updates: prediction, and what the interval buys.</source>
        <translation>Modell identifizieren, dann die Nachführung ausführen: Vorhersage und Nutzen des Intervalls.</translation>
    </message>
    <message>
        <source>Running the updates</source>
        <translation>Nachführung läuft</translation>
    </message>
    <message>
        <source>From %1 h on: rms %2 %3 with %4 measurements, %5 %3 without; fit %6 %, without %7 %.</source>
        <translation>Ab %1 h: rms %2 %3 mit %4 Messungen, %5 %3 ohne; Fit %6 %, ohne %7 %.</translation>
    </message>
    <message>
        <source>Measured</source>
        <translation>Gemessen</translation>
    </message>
    <message>
        <source>Without update</source>
        <translation>Ohne Nachführung</translation>
    </message>
    <message>
        <source>With updates</source>
        <translation>Mit Nachführung</translation>
    </message>
    <message>
        <source>Time / h</source>
        <translation>Zeit / h</translation>
    </message>
    <message>
        <source>%1 / %2</source>
        <translation>%1 / %2</translation>
    </message>
    <message>
        <source>Time between two measurements / min</source>
        <translation>Zeit zwischen zwei Messungen / min</translation>
    </message>
    <message>
        <source>Fit / %</source>
        <translation>Fit / %</translation>
    </message>
    <message>
        <source>Peak to peak / %1</source>
        <translation>Spitze-Spitze / %1</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::VerifyMaps</name>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Thermal state on the table</source>
        <translation>Thermischer Zustand auf dem Tisch</translation>
    </message>
    <message>
        <source>The table will appear here</source>
        <translation>Hier erscheint der Tisch</translation>
    </message>
    <message>
        <source>Compare before and after.</source>
        <translation>Vorher und nachher vergleichen.</translation>
    </message>
    <message>
        <source>The worst after compensating</source>
        <translation>Der schlechteste nach der Kompensation</translation>
    </message>
    <message>
        <source>Before: %1 in %2</source>
        <translation>Vorher: %1 in %2</translation>
    </message>
    <message>
        <source>After: %1 in %2</source>
        <translation>Nachher: %1 in %2</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::VerifyPage</name>
    <message>
        <source>met</source>
        <translation>erreicht</translation>
    </message>
    <message>
        <source>not met</source>
        <translation>nicht erreicht</translation>
    </message>
    <message>
        <source>open</source>
        <translation>offen</translation>
    </message>
    <message>
        <source>not judged</source>
        <translation>nicht beurteilt</translation>
    </message>
    <message>
        <source>Compare before and after</source>
        <translation>Vorher und nachher vergleichen</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Nachher</translation>
    </message>
    <message>
        <source>Goal</source>
        <translation>Ziel</translation>
    </message>
    <message>
        <source>Component</source>
        <translation>Komponente</translation>
    </message>
    <message>
        <source>rms before</source>
        <translation>rms vorher</translation>
    </message>
    <message>
        <source>rms after</source>
        <translation>rms nachher</translation>
    </message>
    <message>
        <source>Largest before</source>
        <translation>Größte vorher</translation>
    </message>
    <message>
        <source>Largest after</source>
        <translation>Größte nachher</translation>
    </message>
    <message>
        <source>Before and after of each component</source>
        <translation>Jede Komponente vorher und nachher</translation>
    </message>
    <message>
        <source>Every component before and after appears here after the comparison.</source>
        <translation>Nach dem Vergleich erscheint hier jede Komponente vorher und nachher.</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Before and after of each point</source>
        <translation>Jeder Punkt vorher und nachher</translation>
    </message>
    <message>
        <source>Every point appears here after the comparison.</source>
        <translation>Nach dem Vergleich erscheint hier jeder Punkt.</translation>
    </message>
    <message>
        <source>Before and after</source>
        <translation>Vorher und nachher</translation>
    </message>
    <message>
        <source>Every value</source>
        <translation>Jeder Wert</translation>
    </message>
    <message>
        <source>On the table</source>
        <translation>Auf dem Tisch</translation>
    </message>
    <message>
        <source>How before and after are shown</source>
        <translation>Wie vorher und nachher gezeigt werden</translation>
    </message>
    <message>
        <source>Component that is drawn</source>
        <translation>Gezeichnete Komponente</translation>
    </message>
    <message>
        <source>Before and after will appear here</source>
        <translation>Hier erscheinen vorher und nachher</translation>
    </message>
    <message>
        <source>Choose the campaign that was measured with the compensation on, then compare.</source>
        <translation>Die Kampagne wählen, die mit eingeschalteter Kompensation gemessen wurde, dann vergleichen.</translation>
    </message>
    <message>
        <source>Measured again in</source>
        <translation>Erneut gemessen in</translation>
    </message>
    <message>
        <source>Campaign measured with the compensation on</source>
        <translation>Mit eingeschalteter Kompensation gemessene Kampagne</translation>
    </message>
    <message>
        <source>Folder …</source>
        <translation>Ordner …</translation>
    </message>
    <message>
        <source>Choose the folder of a campaign</source>
        <translation>Ordner einer Kampagne wählen</translation>
    </message>
    <message>
        <source>Goal of displacements</source>
        <translation>Ziel für Verschiebungen</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>Goal of rotations</source>
        <translation>Ziel für Drehungen</translation>
    </message>
    <message>
        <source>none</source>
        <translation>keines</translation>
    </message>
    <message>
        <source>for the</source>
        <translation>Kriterium</translation>
    </message>
    <message>
        <source>What the goal bounds</source>
        <translation>Was das Ziel begrenzt</translation>
    </message>
    <message>
        <source>largest value</source>
        <translation>größter Wert</translation>
    </message>
    <message>
        <source>rms</source>
        <translation>rms</translation>
    </message>
    <message>
        <source>choose the second campaign</source>
        <translation>zweite Kampagne wählen</translation>
    </message>
    <message>
        <source>set the goal</source>
        <translation>Ziel setzen</translation>
    </message>
    <message>
        <source>choose what the goal bounds</source>
        <translation>wählen, was das Ziel begrenzt</translation>
    </message>
    <message>
        <source>this campaign, while compensating</source>
        <translation>diese Kampagne, während kompensiert wurde</translation>
    </message>
    <message>
        <source>choose a campaign</source>
        <translation>Kampagne wählen</translation>
    </message>
    <message>
        <source>Reading the comparison</source>
        <translation>Der Vergleich wird gelesen</translation>
    </message>
    <message>
        <source>Load the corrections into the control, switch the compensation on and measure the same plan again. Then choose that campaign here; its log says compensation_on = 1.</source>
        <translation>Korrekturen in die Steuerung laden, Kompensation einschalten und denselben Plan erneut messen. Dann diese Kampagne hier wählen; ihr Protokoll enthält compensation_on = 1.</translation>
    </message>
    <message>
        <source>Press Compare before and after.</source>
        <translation>„Vorher und nachher vergleichen“ drücken.</translation>
    </message>
    <message>
        <source>Changed since: %1. Compare again.</source>
        <translation>Geändert seitdem: %1. Erneut vergleichen.</translation>
    </message>
    <message>
        <source>µm</source>
        <translation>µm</translation>
    </message>
    <message>
        <source>largest %1</source>
        <translation>größtes %1</translation>
    </message>
    <message>
        <source>rms %1</source>
        <translation>rms %1</translation>
    </message>
    <message>
        <source>goal %1 µm</source>
        <translation>Ziel %1 µm</translation>
    </message>
    <message>
        <source>Drawing before and after</source>
        <translation>Vorher und nachher werden gezeichnet</translation>
    </message>
    <message>
        <source>%1 at the points</source>
        <translation>%1 an den Punkten</translation>
    </message>
    <message>
        <source>Points before and after</source>
        <translation>Punkte vorher und nachher</translation>
    </message>
    <message>
        <source>Values before and after</source>
        <translation>Werte vorher und nachher</translation>
    </message>
    <message>
        <source>Before on the table</source>
        <translation>Vorher auf dem Tisch</translation>
    </message>
    <message>
        <source>After on the table</source>
        <translation>Nachher auf dem Tisch</translation>
    </message>
    <message numerus="yes">
        <source>%n values compared</source>
        <translation>
            <numerusform>%n Wert verglichen</numerusform>
            <numerusform>%n Werte verglichen</numerusform>
        </translation>
    </message>
    <message>
        <source>Reading the points</source>
        <translation>Punkte werden gelesen</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::View3D</name>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
    <message>
        <source>The 3D view cannot be drawn</source>
        <translation>Die 3D-Ansicht lässt sich nicht zeichnen</translation>
    </message>
    <message>
        <source>Arrows %1 times larger than the deviation</source>
        <translation>Pfeile %1-mal größer als die Abweichung</translation>
    </message>
    <message>
        <source>Height %1 times larger</source>
        <translation>Höhe %1-mal größer</translation>
    </message>
    <message>
        <source>Faded: within %1 σ of zero; striped: outside the points</source>
        <translation>Blass: innerhalb %1 σ von null; schraffiert: außerhalb der Punkte</translation>
    </message>
    <message>
        <source>Faded: within %1 standard uncertainties of zero</source>
        <translation>Blass: innerhalb %1 Standardunsicherheiten von null</translation>
    </message>
    <message>
        <source>Striped: outside the measured points</source>
        <translation>Schraffiert: außerhalb der gemessenen Punkte</translation>
    </message>
    <message>
        <source>%1 %2 mm, %3 %4 mm: %5</source>
        <translation>%1 %2 mm, %3 %4 mm: %5</translation>
    </message>
    <message>
        <source> (extrapolated)</source>
        <translation> (extrapoliert)</translation>
    </message>
    <message>
        <source>Arrow keys turn, plus and minus zoom, R fits, 1 to 4 are standard views, P switches perspective, M measures a distance, C clips.</source>
        <translation>Pfeiltasten drehen, Plus und Minus zoomen, R passt ein, 1 bis 4 sind Standardansichten, P schaltet die Perspektive um, M misst einen Abstand, C schneidet.</translation>
    </message>
    <message>
        <source>Distance: click the first place</source>
        <translation>Abstand: erste Stelle anklicken</translation>
    </message>
    <message>
        <source>Distance: click the second place</source>
        <translation>Abstand: zweite Stelle anklicken</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1: %2</translation>
    </message>
    <message>
        <source>%1 %2</source>
        <translation>%1 %2</translation>
    </message>
    <message>
        <source>%1 %2 %3</source>
        <translation>%1 %2 %3</translation>
    </message>
    <message>
        <source>%1, %2: %3</source>
        <translation>%1, %2: %3</translation>
    </message>
    <message>
        <source>x %1 mm, y %2 mm, z %3 mm</source>
        <translation>x %1 mm, y %2 mm, z %3 mm</translation>
    </message>
    <message>
        <source>scan</source>
        <translation>Scan</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::ViewTools</name>
    <message>
        <source>View</source>
        <translation>Ansicht</translation>
    </message>
    <message>
        <source>Front</source>
        <translation>Vorn</translation>
    </message>
    <message>
        <source>Top</source>
        <translation>Oben</translation>
    </message>
    <message>
        <source>Right</source>
        <translation>Rechts</translation>
    </message>
    <message>
        <source>Isometric</source>
        <translation>Isometrisch</translation>
    </message>
    <message>
        <source>Fit</source>
        <translation>Einpassen</translation>
    </message>
    <message>
        <source>Perspective</source>
        <translation>Perspektive</translation>
    </message>
    <message>
        <source>Measure a distance</source>
        <translation>Abstand messen</translation>
    </message>
    <message>
        <source>Clip plane</source>
        <translation>Schnittebene</translation>
    </message>
    <message>
        <source>Axis the clip plane stands across</source>
        <translation>Achse senkrecht zur Schnittebene</translation>
    </message>
    <message>
        <source>Place of the clip plane</source>
        <translation>Lage der Schnittebene</translation>
    </message>
    <message>
        <source>Keep the other side</source>
        <translation>Andere Seite behalten</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::WarmUpPage</name>
    <message>
        <source>The instrument was warm</source>
        <translation>Das Messgerät war warm</translation>
    </message>
    <message>
        <source>Records your statement, so that the report can say on what it rests</source>
        <translation>Hält diese Erklärung fest, damit der Bericht sagen kann, worauf er beruht</translation>
    </message>
    <message>
        <source>Drift curves will appear here</source>
        <translation>Hier erscheinen die Driftkurven</translation>
    </message>
    <message>
        <source>Measure one point every 5 minutes while the instrument warms up: its drift shows when it has settled.</source>
        <translation>Während das Messgerät warm wird, alle 5 Minuten einen Punkt messen: seine Drift zeigt, wann es eingelaufen ist.</translation>
    </message>
    <message>
        <source>Axis</source>
        <translation>Achse</translation>
    </message>
    <message>
        <source>Time constant</source>
        <translation>Zeitkonstante</translation>
    </message>
    <message>
        <source>Settles after</source>
        <translation>Eingelaufen nach</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Drift of each axis</source>
        <translation>Drift jeder Achse</translation>
    </message>
    <message>
        <source>Drift and time constant of each axis appear here.</source>
        <translation>Hier erscheinen Drift und Zeitkonstante jeder Achse.</translation>
    </message>
    <message>
        <source>Drift</source>
        <translation>Drift</translation>
    </message>
    <message>
        <source>Jog the table by known steps, five or more, and capture the same fiducial after each: what the microscope reads beside the commanded step must stay within one resolution of the axis.</source>
        <translation>Den Tisch um bekannte Schritte verfahren, mindestens fünf, und nach jedem dieselbe Messmarke aufnehmen: der Messwert des Mikroskops muss innerhalb einer Auflösung der Achse mit dem Sollschritt übereinstimmen.</translation>
    </message>
    <message>
        <source>Check the jogs</source>
        <translation>Verfahrschritte prüfen</translation>
    </message>
    <message>
        <source>Jogs</source>
        <translation>Verfahrschritte</translation>
    </message>
    <message>
        <source>Measure the same fiducials again and again on the cold machine, one state each time: the readings must come back within half a resolution of the axis.</source>
        <translation>Dieselben Messmarken an der kalten Maschine wiederholt messen, jedes Mal als ein Zustand: die Messwerte müssen innerhalb einer halben Auflösung der Achse wiederkehren.</translation>
    </message>
    <message>
        <source>Check the repeatability</source>
        <translation>Wiederholpräzision prüfen</translation>
    </message>
    <message>
        <source>Cold repeatability</source>
        <translation>Wiederholpräzision kalt</translation>
    </message>
    <message>
        <source>Clocks</source>
        <translation>Uhren</translation>
    </message>
    <message>
        <source>Temperatures</source>
        <translation>Temperaturen</translation>
    </message>
    <message>
        <source>Temperatures will appear here</source>
        <translation>Hier erscheinen die Temperaturen</translation>
    </message>
    <message>
        <source>They come from log.csv of the campaign; this one has none.</source>
        <translation>Sie stammen aus log.csv der Kampagne; diese hat keine.</translation>
    </message>
    <message>
        <source>take back that the instrument was warm</source>
        <translation>zurücknehmen, dass das Messgerät warm war</translation>
    </message>
    <message>
        <source>state that the instrument was warm</source>
        <translation>erklären, dass das Messgerät warm war</translation>
    </message>
    <message>
        <source>Reading the log that is being recorded</source>
        <translation>Das laufende Protokoll wird gelesen</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>Temperature / °C</source>
        <translation>Temperatur / °C</translation>
    </message>
    <message>
        <source>%1 min</source>
        <translation>%1 min</translation>
    </message>
    <message>
        <source>settled</source>
        <translation>eingelaufen</translation>
    </message>
    <message>
        <source>Deviation of %1 / µm</source>
        <translation>Abweichung von %1 / µm</translation>
    </message>
    <message>
        <source>Withdraw the statement</source>
        <translation>Angabe zurücknehmen</translation>
    </message>
    <message>
        <source>Drift now / (µm/h)</source>
        <translation>Drift jetzt / (µm/h)</translation>
    </message>
    <message>
        <source>Check the drift</source>
        <translation>Drift prüfen</translation>
    </message>
    <message>
        <source>Longer than the record: its end was not seen, so it cannot be determined.</source>
        <translation>Länger als die Aufzeichnung: ihr Ende wurde nicht gesehen, darum ist sie nicht bestimmbar.</translation>
    </message>
    <message>
        <source>Too short to be determined from readings this far apart.</source>
        <translation>Zu kurz, um aus Messwerten in diesem Abstand bestimmt zu werden.</translation>
    </message>
    <message>
        <source>drifts</source>
        <translation>driftet</translation>
    </message>
    <message>
        <source>not decidable</source>
        <translation>nicht entscheidbar</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::WelcomePage</name>
    <message>
        <source>Welcome</source>
        <translation>Willkommen</translation>
    </message>
    <message>
        <source>Measure, understand and compensate the thermal errors of machine tools.</source>
        <translation>Thermische Abweichungen von Werkzeugmaschinen messen, verstehen und kompensieren.</translation>
    </message>
    <message>
        <source>New measurement …</source>
        <translation>Neue Messung …</translation>
    </message>
    <message>
        <source>Open session …</source>
        <translation>Sitzung öffnen …</translation>
    </message>
    <message>
        <source>Open campaign folder …</source>
        <translation>Kampagnenordner öffnen …</translation>
    </message>
    <message>
        <source>Plant …</source>
        <translation>Werk …</translation>
    </message>
    <message>
        <source>All machines of a plant: due dates, trends, batches</source>
        <translation>Alle Maschinen eines Werks: Fälligkeiten, Verläufe, Batch-Aufträge</translation>
    </message>
    <message>
        <source>Try it on the virtual machine</source>
        <translation>An der virtuellen Maschine ausprobieren</translation>
    </message>
    <message>
        <source>Recent sessions</source>
        <translation>Letzte Sitzungen</translation>
    </message>
    <message>
        <source>Session %1 was not closed properly. Everything that was captured is there; a calculation that was running must be started again.</source>
        <translation>Die Sitzung %1 wurde nicht ordnungsgemäß geschlossen. Alles Aufgenommene ist vorhanden; eine laufende Berechnung muss neu gestartet werden.</translation>
    </message>
    <message>
        <source>Open it again</source>
        <translation>Wieder öffnen</translation>
    </message>
    <message>
        <source>Sessions you open appear here. Everything measured is kept in its session&apos;s folder.</source>
        <translation>Geöffnete Sitzungen erscheinen hier. Alles Gemessene wird im Ordner seiner Sitzung aufbewahrt.</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::WhatIfWindow</name>
    <message>
        <source>Squareness</source>
        <translation>Rechtwinkligkeitsabweichungen</translation>
    </message>
    <message>
        <source>Location of the rotary table C</source>
        <translation>Lage des Drehtisches C</translation>
    </message>
    <message>
        <source>Axis %1</source>
        <translation>Achse %1</translation>
    </message>
    <message>
        <source>Square</source>
        <translation>Quadrat</translation>
    </message>
    <message>
        <source>Square, side %1</source>
        <translation>Quadrat, Seite %1</translation>
    </message>
    <message>
        <source>Diamond, side %1</source>
        <translation>Raute, Seite %1</translation>
    </message>
    <message>
        <source>Inclined face %1</source>
        <translation>Geneigte Fläche %1</translation>
    </message>
    <message>
        <source>Circle</source>
        <translation>Kreis</translation>
    </message>
    <message>
        <source>Centre bore</source>
        <translation>Mittelbohrung</translation>
    </message>
    <message>
        <source>Hole %1</source>
        <translation>Bohrung %1</translation>
    </message>
    <message>
        <source>Holes</source>
        <translation>Bohrungen</translation>
    </message>
    <message>
        <source>Straightness</source>
        <translation>Geradheit</translation>
    </message>
    <message>
        <source>Perpendicularity to %1</source>
        <translation>Rechtwinkligkeit zu %1</translation>
    </message>
    <message>
        <source>Parallelism to %1</source>
        <translation>Parallelität zu %1</translation>
    </message>
    <message>
        <source>Angularity to %1</source>
        <translation>Neigung zu %1</translation>
    </message>
    <message>
        <source>Squareness of its sides</source>
        <translation>Rechtwinkligkeit der Seiten</translation>
    </message>
    <message>
        <source>Size along X</source>
        <translation>Maß entlang X</translation>
    </message>
    <message>
        <source>Size along Y</source>
        <translation>Maß entlang Y</translation>
    </message>
    <message>
        <source>Circularity, minimum zone</source>
        <translation>Rundheit, Minimumzone</translation>
    </message>
    <message>
        <source>Circularity, least squares</source>
        <translation>Rundheit, kleinste Quadrate</translation>
    </message>
    <message>
        <source>Diameter</source>
        <translation>Durchmesser</translation>
    </message>
    <message>
        <source>Concentricity to %1</source>
        <translation>Konzentrizität zu %1</translation>
    </message>
    <message>
        <source>Position from %1 and B</source>
        <translation>Position bezogen auf %1 und B</translation>
    </message>
    <message>
        <source>Distance along X</source>
        <translation>Abstand entlang X</translation>
    </message>
    <message>
        <source>Distance along Y</source>
        <translation>Abstand entlang Y</translation>
    </message>
    <message>
        <source>Hole bar</source>
        <translation>Lochleiste</translation>
    </message>
    <message>
        <source>Ball artefact</source>
        <translation>Kugelnormal</translation>
    </message>
    <message>
        <source>Fiducial plate</source>
        <translation>Messmarkenplatte</translation>
    </message>
    <message>
        <source>What if</source>
        <translation>Was wäre, wenn</translation>
    </message>
    <message>
        <source>Move an error of the machine and see what it does to probing points, artefacts and a milled part.</source>
        <translation>Eine Abweichung der Maschine verstellen und sehen, was sie an Antastpunkten, Prüfkörpern und einem gefrästen Werkstück bewirkt.</translation>
    </message>
    <message>
        <source>Machine with the deviations at its probing points</source>
        <translation>Maschine mit den Abweichungen an ihren Antastpunkten</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Test part (of the kind of ISO 10791-7)</source>
        <translation>Prüfwerkstück (nach Art der ISO 10791-7)</translation>
    </message>
    <message>
        <source>Feature</source>
        <translation>Merkmal</translation>
    </message>
    <message>
        <source>Characteristic</source>
        <translation>Kenngröße</translation>
    </message>
    <message>
        <source>Value</source>
        <translation>Wert</translation>
    </message>
    <message>
        <source>Unit</source>
        <translation>Einheit</translation>
    </message>
    <message>
        <source>Nominal / mm</source>
        <translation>Nennwert / mm</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>X / mm</source>
        <translation>X / mm</translation>
    </message>
    <message>
        <source>Y / mm</source>
        <translation>Y / mm</translation>
    </message>
    <message>
        <source>Z / mm</source>
        <translation>Z / mm</translation>
    </message>
    <message>
        <source>EX / µm</source>
        <translation>EX / µm</translation>
    </message>
    <message>
        <source>EY / µm</source>
        <translation>EY / µm</translation>
    </message>
    <message>
        <source>EZ / µm</source>
        <translation>EZ / µm</translation>
    </message>
    <message>
        <source>EA / µrad</source>
        <translation>EA / µrad</translation>
    </message>
    <message>
        <source>EB / µrad</source>
        <translation>EB / µrad</translation>
    </message>
    <message>
        <source>EC / µrad</source>
        <translation>EC / µrad</translation>
    </message>
    <message>
        <source>Characteristics of the test part</source>
        <translation>Kenngrößen des Prüfwerkstücks</translation>
    </message>
    <message>
        <source>Test part</source>
        <translation>Prüfwerkstück</translation>
    </message>
    <message>
        <source>Deviations at the probing points</source>
        <translation>Abweichungen an den Antastpunkten</translation>
    </message>
    <message>
        <source>Probing points</source>
        <translation>Antastpunkte</translation>
    </message>
    <message>
        <source>Artefact</source>
        <translation>Prüfkörper</translation>
    </message>
    <message>
        <source>Deviations of the features of the artefact</source>
        <translation>Abweichungen der Merkmale des Prüfkörpers</translation>
    </message>
    <message>
        <source>Artefacts</source>
        <translation>Prüfkörper</translation>
    </message>
    <message>
        <source>Find a parameter or effect</source>
        <translation>Parameter oder Effekt suchen</translation>
    </message>
    <message>
        <source>All to zero</source>
        <translation>Alle auf null</translation>
    </message>
    <message>
        <source>%1, %2 %3 per %4</source>
        <translation>%1, %2 %3 je %4</translation>
    </message>
    <message>
        <source>Relative to %1</source>
        <translation>Bezogen auf %1</translation>
    </message>
    <message>
        <source>; deviation along the bar %1 µm/m</source>
        <translation>; Abweichung entlang der Leiste %1 µm/m</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::WhatPanel</name>
    <message>
        <source>Effects</source>
        <translation>Effekte</translation>
    </message>
    <message>
        <source>Effect</source>
        <translation>Effekt</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>Gain in BIC</source>
        <translation>Gewinn in BIC</translation>
    </message>
    <message>
        <source>Effects found</source>
        <translation>Gefundene Effekte</translation>
    </message>
    <message>
        <source>Effects appear after the search.</source>
        <translation>Effekte erscheinen nach der Suche.</translation>
    </message>
    <message>
        <source>Most probable</source>
        <translation>Wahrscheinlichste</translation>
    </message>
    <message>
        <source>Parameters</source>
        <translation>Parameter</translation>
    </message>
    <message>
        <source>What is listed</source>
        <translation>Was aufgeführt wird</translation>
    </message>
    <message>
        <source>Probability</source>
        <translation>Wahrscheinlichkeit</translation>
    </message>
    <message>
        <source>Answer</source>
        <translation>Antwort</translation>
    </message>
    <message>
        <source>Most probable effects</source>
        <translation>Wahrscheinlichste Effekte</translation>
    </message>
    <message>
        <source>The ten most probable effects appear after the search.</source>
        <translation>Nach der Suche erscheinen hier die zehn wahrscheinlichsten Effekte.</translation>
    </message>
    <message>
        <source>Parameter, jointly fitted</source>
        <translation>Parameter, gemeinsam angepasst</translation>
    </message>
    <message>
        <source>Value ± standard uncertainty</source>
        <translation>Wert ± Standardunsicherheit</translation>
    </message>
    <message>
        <source>Parameters of the effect</source>
        <translation>Parameter des Effekts</translation>
    </message>
    <message>
        <source>No effect is chosen.</source>
        <translation>Es ist kein Effekt gewählt.</translation>
    </message>
    <message>
        <source>Do not consider</source>
        <translation>Nicht berücksichtigen</translation>
    </message>
    <message>
        <source>Search again without this effect</source>
        <translation>Ohne diesen Effekt erneut suchen</translation>
    </message>
    <message>
        <source>Confidence</source>
        <translation>Konfidenz</translation>
    </message>
    <message>
        <source>Held-out rms</source>
        <translation>rms der Validierungsdaten</translation>
    </message>
    <message>
        <source>What happens</source>
        <translation>Was geschieht</translation>
    </message>
    <message>
        <source>What the effects explain will appear here</source>
        <translation>Hier erscheint, was die Effekte erklären</translation>
    </message>
    <message>
        <source>Search, or choose another place.</source>
        <translation>Suchen oder eine andere Stelle wählen.</translation>
    </message>
    <message>
        <source>added</source>
        <translation>hinzugefügt</translation>
    </message>
    <message>
        <source>proposed</source>
        <translation>vorgeschlagen</translation>
    </message>
    <message>
        <source>or: %1</source>
        <translation>oder: %1</translation>
    </message>
    <message>
        <source>rival</source>
        <translation>konkurrierende Erklärung</translation>
    </message>
    <message>
        <source>No effect is missing.</source>
        <translation>Es fehlt kein Effekt.</translation>
    </message>
    <message>
        <source>These data cannot decide what is missing.</source>
        <translation>Diese Daten können nicht entscheiden, was fehlt.</translation>
    </message>
    <message>
        <source>Nothing can be named: no effect of the catalogue explains the residual.</source>
        <translation>Nichts lässt sich benennen: kein Effekt des Katalogs erklärt das Residuum.</translation>
    </message>
    <message>
        <source>Nothing can be named: the remainder is %1, which no effect of the catalogue explains.</source>
        <translation>Nichts lässt sich benennen: der Rest beträgt %1, und kein Effekt des Katalogs erklärt ihn.</translation>
    </message>
    <message>
        <source>Probability that it is among what is missing, before rivals and the remainder are weighed</source>
        <translation>Wahrscheinlichkeit, dass er zum Fehlenden gehört, bevor konkurrierende Erklärungen und Rest abgewogen sind</translation>
    </message>
    <message>
        <source>named</source>
        <translation>benannt</translation>
    </message>
    <message>
        <source>nested model</source>
        <translation>eingebettetes Modell</translation>
    </message>
    <message>
        <source>Contains the named effect as a special case</source>
        <translation>Enthält den benannten Effekt als Sonderfall</translation>
    </message>
    <message>
        <source>rejected</source>
        <translation>verworfen</translation>
    </message>
    <message>
        <source>No effect of the catalogue is probable.</source>
        <translation>Kein Effekt des Katalogs ist wahrscheinlich.</translation>
    </message>
    <message>
        <source>What happens in the machine</source>
        <translation>Was in der Maschine geschieht</translation>
    </message>
    <message>
        <source>What remains</source>
        <translation>Was verbleibt</translation>
    </message>
    <message>
        <source>The physics of the effect and the evidence for it will appear here.</source>
        <translation>Hier erscheinen die Physik des Effekts und die Evidenz für ihn.</translation>
    </message>
    <message>
        <source>Nothing is missing in the simulation.</source>
        <translation>In der Simulation fehlt nichts.</translation>
    </message>
    <message>
        <source>that the named effect is the right one</source>
        <translation>dass der benannte Effekt der richtige ist</translation>
    </message>
    <message>
        <source>that it is one of these</source>
        <translation>dass es einer von diesen ist</translation>
    </message>
    <message>
        <source>above 10 is very strong</source>
        <translation>über 10 ist sehr stark</translation>
    </message>
    <message>
        <source>%1 → %2</source>
        <translation>%1 → %2</translation>
    </message>
    <message>
        <source>observations held out</source>
        <translation>Beobachtungen als Validierungsdaten</translation>
    </message>
    <message>
        <source>blocks left out in turn</source>
        <translation>reihum ausgelassene Blöcke</translation>
    </message>
    <message>
        <source>These data cannot distinguish %1. Choose the one that is known to be present, or measure what the last tab proposes.</source>
        <translation>Diese Daten können nicht unterscheiden: %1. Den wählen, der bekanntermaßen vorliegt, oder messen, was der letzte Reiter vorschlägt.</translation>
    </message>
    <message>
        <source>or</source>
        <translation>oder</translation>
    </message>
    <message>
        <source>Driver: %1.</source>
        <translation>Antriebsgröße: %1.</translation>
    </message>
    <message>
        <source>Also part of %1.</source>
        <translation>Auch Teil von %1.</translation>
    </message>
    <message>
        <source>and</source>
        <translation>und</translation>
    </message>
    <message>
        <source>Displacement at the tool: %1 rms. Id: %2.</source>
        <translation>Verlagerung am Werkzeug: %1 rms. Kennung: %2.</translation>
    </message>
    <message>
        <source>The values are those of %1, which fits equally well. Add this effect instead to see its own.</source>
        <translation>Die Werte sind die von %1, der ebenso gut passt. Diesen Effekt stattdessen hinzufügen, um seine eigenen zu sehen.</translation>
    </message>
    <message>
        <source>%1 of %2: unexplained</source>
        <translation>%1 von %2: nicht erklärt</translation>
    </message>
    <message>
        <source>%1 of %2: explained</source>
        <translation>%1 von %2: erklärt</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>%1 residual / %2</source>
        <translation>Residuum %1 / %2</translation>
    </message>
    <message>
        <source>measured − simulated</source>
        <translation>gemessen − simuliert</translation>
    </message>
    <message>
        <source>effects, ± 2 σ noise</source>
        <translation>Effekte, ± 2 σ Rauschen</translation>
    </message>
    <message>
        <source>What the effects explain</source>
        <translation>Was die Effekte erklären</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::WherePanel</name>
    <message>
        <source>Places, the clearest first</source>
        <translation>Stellen, die deutlichste zuerst</translation>
    </message>
    <message>
        <source>What</source>
        <translation>Was</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>When</source>
        <translation>Zeitpunkt</translation>
    </message>
    <message>
        <source>Excess</source>
        <translation>Überschuss</translation>
    </message>
    <message>
        <source>p</source>
        <translation>p</translation>
    </message>
    <message>
        <source>Places where measured and simulated disagree</source>
        <translation>Stellen, an denen Messung und Simulation voneinander abweichen</translation>
    </message>
    <message>
        <source>Places where the residual exceeds the noise appear after the search.</source>
        <translation>Stellen, an denen das Residuum das Rauschen übersteigt, erscheinen nach der Suche.</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Punkt</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Vorher</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Nachher</translation>
    </message>
    <message>
        <source>Noise</source>
        <translation>Rauschen</translation>
    </message>
    <message>
        <source>Points with what lies beyond the noise</source>
        <translation>Punkte mit dem, was über das Rauschen hinausgeht</translation>
    </message>
    <message>
        <source>Points appear after the search.</source>
        <translation>Punkte erscheinen nach der Suche.</translation>
    </message>
    <message>
        <source>Over time</source>
        <translation>Über der Zeit</translation>
    </message>
    <message>
        <source>On the machine</source>
        <translation>An der Maschine</translation>
    </message>
    <message>
        <source>What is shown</source>
        <translation>Was gezeigt wird</translation>
    </message>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>The points will appear here</source>
        <translation>Hier erscheinen die Punkte</translation>
    </message>
    <message>
        <source>Search: each point is coloured by what lies beyond the noise.</source>
        <translation>Suchen: jeder Punkt wird nach dem gefärbt, was über das Rauschen hinausgeht.</translation>
    </message>
    <message>
        <source>The residual over time will appear here</source>
        <translation>Hier erscheint das Residuum über der Zeit</translation>
    </message>
    <message>
        <source>Search, then choose a place in the table or a point on the machine.</source>
        <translation>Suchen, dann eine Stelle in der Tabelle oder einen Punkt an der Maschine wählen.</translation>
    </message>
    <message>
        <source>Click a value: its place is chosen, and the machine is shown at its time</source>
        <translation>Wert anklicken: seine Stelle wird gewählt und die Maschine zu diesem Zeitpunkt gezeigt</translation>
    </message>
    <message>
        <source>rms beyond what the noise explains</source>
        <translation>rms über das hinaus, was das Rauschen erklärt</translation>
    </message>
    <message>
        <source>Probability of this by chance, for all places looked at together</source>
        <translation>Wahrscheinlichkeit, dass dies zufällig auftritt, für alle betrachteten Stellen zusammen</translation>
    </message>
    <message>
        <source>At no place does the residual exceed the noise.</source>
        <translation>An keiner Stelle übersteigt das Residuum das Rauschen.</translation>
    </message>
    <message>
        <source>Component</source>
        <translation>Komponente</translation>
    </message>
    <message>
        <source>Points, rms over time / %1</source>
        <translation>Punkte, rms über die Zeit / %1</translation>
    </message>
    <message>
        <source>%1 beyond the noise, rms over time; dotted: the noise explains it</source>
        <translation>%1 über das Rauschen hinaus, rms über die Zeit; gepunktet: durch das Rauschen erklärt</translation>
    </message>
    <message>
        <source>%1 of point %2 over time</source>
        <translation>%1 des Punkts %2 über der Zeit</translation>
    </message>
    <message>
        <source>Time / %1</source>
        <translation>Zeit / %1</translation>
    </message>
    <message>
        <source>%1 residual / %2</source>
        <translation>Residuum %1 / %2</translation>
    </message>
    <message>
        <source>noise, ± 2 σ</source>
        <translation>Rauschen, ± 2 σ</translation>
    </message>
    <message>
        <source>measured − simulated</source>
        <translation>gemessen − simuliert</translation>
    </message>
    <message>
        <source>before</source>
        <translation>vorher</translation>
    </message>
    <message>
        <source>after adding</source>
        <translation>nach dem Hinzufügen</translation>
    </message>
    <message>
        <source>held out</source>
        <translation>Validierungsdaten</translation>
    </message>
    <message>
        <source>place chosen</source>
        <translation>gewählte Stelle</translation>
    </message>
    <message>
        <source>Places</source>
        <translation>Stellen</translation>
    </message>
    <message>
        <source>Points %1</source>
        <translation>Punkte %1</translation>
    </message>
    <message>
        <source>Excess on the machine %1</source>
        <translation>Überschuss an der Maschine %1</translation>
    </message>
    <message>
        <source>Residual %1 %2</source>
        <translation>Residuum %1 %2</translation>
    </message>
    <message>
        <source>More than the noise allows: at one of the places above, or over all of the time</source>
        <translation>Mehr, als das Rauschen zulässt: an einer der Stellen oben oder über die ganze Zeit</translation>
    </message>
</context>
<context>
    <name>spindrift::gui::Workflow</name>
    <message>
        <source>Machine</source>
        <translation>Maschine</translation>
    </message>
    <message>
        <source>Warm-up</source>
        <translation>Warmlauf</translation>
    </message>
    <message>
        <source>Capture</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Kalibrieren</translation>
    </message>
    <message>
        <source>Model</source>
        <translation>Modell</translation>
    </message>
    <message>
        <source>Discrepancy</source>
        <translation>Diskrepanz</translation>
    </message>
    <message>
        <source>Compensate</source>
        <translation>Kompensieren</translation>
    </message>
    <message>
        <source>Verify</source>
        <translation>Verifizieren</translation>
    </message>
    <message>
        <source>Review</source>
        <translation>Durchsicht</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Check that this is the machine in front of you: chain, travels, measuring points.</source>
        <translation>Prüfen, ob dies die Maschine ist, vor der man steht: Kette, Verfahrwege, Messpunkte.</translation>
    </message>
    <message>
        <source>Wait until the instrument has settled; until then its drift would be mistaken for drift of the machine.</source>
        <translation>Warten, bis das Messgerät eingelaufen ist; bis dahin würde seine Drift für Drift der Maschine gehalten.</translation>
    </message>
    <message>
        <source>Take every capture of the plan, and repeat those that cannot be used while you are at the machine.</source>
        <translation>Jede Aufnahme des Plans machen und unbrauchbare wiederholen, solange man an der Maschine steht.</translation>
    </message>
    <message>
        <source>Find the centre of rotation, the axis directions and the heights, and turn captures into deviations.</source>
        <translation>Drehzentrum, Achsrichtungen und Höhen bestimmen und Aufnahmen in Abweichungen umsetzen.</translation>
    </message>
    <message>
        <source>Fit the error model, choose which points fit and which validate, and look at the heat map.</source>
        <translation>Fehlermodell anpassen, anzupassende und validierende Punkte wählen und die Farbkarte ansehen.</translation>
    </message>
    <message>
        <source>Find where simulation and measurement disagree, and which effect is missing.</source>
        <translation>Feststellen, wo Simulation und Messung voneinander abweichen und welcher Effekt fehlt.</translation>
    </message>
    <message>
        <source>See what the model would command, and export it for the control.</source>
        <translation>Ansehen, welche Korrektur das Modell vorgibt, und sie für die Steuerung exportieren.</translation>
    </message>
    <message>
        <source>Measure the same plan again with the compensation on, and see whether the goal is met.</source>
        <translation>Denselben Plan mit eingeschalteter Kompensation erneut messen und sehen, ob das Ziel erreicht ist.</translation>
    </message>
    <message>
        <source>Compare thermal states, models, campaigns and scans side by side.</source>
        <translation>Thermische Zustände, Modelle, Kampagnen und Scans nebeneinander vergleichen.</translation>
    </message>
    <message>
        <source>Read the whole evaluation through and save it as a report.</source>
        <translation>Die gesamte Auswertung durchlesen und als Bericht speichern.</translation>
    </message>
    <message>
        <source>not started</source>
        <translation>nicht begonnen</translation>
    </message>
    <message>
        <source>in progress</source>
        <translation>in Arbeit</translation>
    </message>
    <message>
        <source>attention</source>
        <translation>beachten</translation>
    </message>
    <message>
        <source>done</source>
        <translation>erledigt</translation>
    </message>
    <message>
        <source>outdated</source>
        <translation>veraltet</translation>
    </message>
    <message>
        <source>blocked</source>
        <translation>blockiert</translation>
    </message>
    <message>
        <source>Open a session or a campaign first.</source>
        <translation>Zuerst eine Sitzung oder eine Kampagne öffnen.</translation>
    </message>
    <message>
        <source>%1 of %2</source>
        <translation>%1 von %2</translation>
    </message>
</context>
</TS>
