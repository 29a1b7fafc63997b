<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de" sourcelanguage="en">
<context>
    <name>App::Property</name>
    <message>
        <source>The solid, body, link or compound to decompose</source>
        <translation>Der Festkörper, Body, Link oder Verbund, der zerlegt wird</translation>
    </message>
    <message>
        <source>How far chords may be from round faces; 0 chooses by size</source>
        <translation>Wie weit Sehnen von runden Flächen abweichen dürfen; 0 wählt nach der Größe</translation>
    </message>
    <message>
        <source>Angle between neighbouring chords of round faces; 0 is automatic</source>
        <translation>Winkel zwischen benachbarten Sehnen runder Flächen; 0 ist automatisch</translation>
    </message>
    <message>
        <source>Version of this list of properties</source>
        <translation>Version dieser Liste von Eigenschaften</translation>
    </message>
    <message>
        <source>Number of pieces</source>
        <translation>Anzahl der Teile</translation>
    </message>
    <message>
        <source>Number of reflex edges of the solid</source>
        <translation>Anzahl der einspringenden Kanten des Festkörpers</translation>
    </message>
    <message>
        <source>Number of points that the solid did not have</source>
        <translation>Anzahl der Punkte, die der Festkörper nicht hatte</translation>
    </message>
    <message>
        <source>Volume of all pieces against the tessellated solid, relative</source>
        <translation>Volumen aller Teile gegenüber dem facettierten Festkörper, relativ</translation>
    </message>
    <message>
        <source>Time of the computation</source>
        <translation>Dauer der Berechnung</translation>
    </message>
    <message>
        <source>Up to so many pieces become solids; more are drawn</source>
        <translation>Bis zu so viele Teile werden Festkörper; mehr werden gezeichnet</translation>
    </message>
    <message>
        <source>How far pieces are moved apart, as a share</source>
        <translation>Wie weit die Teile auseinandergerückt werden, als Anteil</translation>
    </message>
    <message>
        <source>Direction of the walls: auto, x, y, z or A,B,C</source>
        <translation>Richtung der Wände: auto, x, y, z oder A,B,C</translation>
    </message>
    <message>
        <source>How the solid is decomposed</source>
        <translation>Wie der Festkörper zerlegt wird</translation>
    </message>
    <message>
        <source>Grid steps within which facets of one plane are coplanar, 0 to 8</source>
        <translation>Gitterschritte, in denen Facetten einer Ebene als koplanar gelten, 0 bis 8</translation>
    </message>
    <message>
        <source>1 for straight tetrahedra, 2 for middle nodes too</source>
        <translation>1 für gerade Tetraeder, 2 auch für Mittelknoten</translation>
    </message>
    <message>
        <source>Rebuild the elements by the program mmg3d</source>
        <translation>Die Elemente mit dem Programm mmg3d neu aufbauen</translation>
    </message>
    <message>
        <source>Longest edge of elements; 0 chooses by size</source>
        <translation>Längste Kante der Elemente; 0 wählt nach der Größe</translation>
    </message>
    <message>
        <source>Elements around a round face, with Quality; 0 is automatic</source>
        <translation>Elemente rund um eine runde Fläche, mit Qualität; 0 ist automatisch</translation>
    </message>
    <message>
        <source>Longest edges on faces, with Quality: Face3=0.5</source>
        <translation>Längste Kanten auf Flächen, mit Qualität: Face3=0.5</translation>
    </message>
    <message>
        <source>How often every element is divided into eight</source>
        <translation>Wie oft jedes Element in acht geteilt wird</translation>
    </message>
    <message>
        <source>What to do when a load does not arrive on the mesh</source>
        <translation>Was zu tun ist, wenn eine Last nicht im Netz ankommt</translation>
    </message>
    <message>
        <source>Those of the analysis that the mesh has groups for</source>
        <translation>Jene der Analyse, für die das Netz Gruppen hat</translation>
    </message>
</context>
<context>
    <name>Tetra</name>
    <message>
        <source>Open or create a document first</source>
        <translation>Zuerst ein Dokument öffnen oder anlegen</translation>
    </message>
    <message>
        <source>Close the open task first</source>
        <translation>Zuerst die offene Aufgabe schließen</translation>
    </message>
    <message>
        <source>Tetra</source>
        <translation>Tetra</translation>
    </message>
    <message>
        <source>Checking {0}...</source>
        <translation>{0} wird geprüft...</translation>
    </message>
    <message>
        <source>Check solid</source>
        <translation>Festkörper prüfen</translation>
    </message>
    <message>
        <source>Select all faces at fault</source>
        <translation>Alle fehlerhaften Flächen auswählen</translation>
    </message>
    <message>
        <source>{0} is a valid solid: it can be decomposed.</source>
        <translation>{0} ist ein gültiger Festkörper: er kann zerlegt werden.</translation>
    </message>
    <message>
        <source>{0} is not a valid solid. What is wrong: {1}</source>
        <translation>{0} ist kein gültiger Festkörper. Fehler: {1}</translation>
    </message>
    <message>
        <source>Chord height</source>
        <translation>Sehnenhöhe</translation>
    </message>
    <message>
        <source>Chord angle</source>
        <translation>Sehnenwinkel</translation>
    </message>
    <message>
        <source>Flatness</source>
        <translation>Ebenheit</translation>
    </message>
    <message>
        <source>Solids up to</source>
        <translation>Festkörper bis</translation>
    </message>
    <message>
        <source>Method</source>
        <translation>Verfahren</translation>
    </message>
    <message>
        <source>Direction</source>
        <translation>Richtung</translation>
    </message>
    <message>
        <source>How the solid is cut; automatic takes the fewer pieces</source>
        <translation>Wie der Festkörper zerschnitten wird; automatisch nimmt die wenigeren Teile</translation>
    </message>
    <message>
        <source>Direction of the walls: an axis, or three whole numbers such as 1,0,2; automatic takes the cheapest</source>
        <translation>Richtung der Wände: eine Achse oder drei ganze Zahlen wie 1,0,2; automatisch nimmt die günstigste</translation>
    </message>
    <message>
        <source>How far chords may be from round faces; 0 is automatic</source>
        <translation>Wie weit Sehnen von runden Flächen abweichen dürfen; 0 ist automatisch</translation>
    </message>
    <message>
        <source>The angle between neighbouring chords of round faces; 0 is automatic</source>
        <translation>Der Winkel zwischen benachbarten Sehnen runder Flächen; 0 ist automatisch</translation>
    </message>
    <message>
        <source>Grid steps within which the facets of one plane count as flat</source>
        <translation>Gitterschritte, in denen die Facetten einer Ebene als eben gelten</translation>
    </message>
    <message>
        <source>Up to so many pieces become solids; more are drawn only</source>
        <translation>Bis zu so viele Teile werden Festkörper; mehr werden nur gezeichnet</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>X axis</source>
        <translation>X-Achse</translation>
    </message>
    <message>
        <source>Y axis</source>
        <translation>Y-Achse</translation>
    </message>
    <message>
        <source>Z axis</source>
        <translation>Z-Achse</translation>
    </message>
    <message>
        <source>Cut notches (Bajaj, Dey)</source>
        <translation>Kerben schneiden (Bajaj, Dey)</translation>
    </message>
    <message>
        <source>Fences (Chazelle, Palios)</source>
        <translation>Zäune (Chazelle, Palios)</translation>
    </message>
    <message>
        <source>Choices</source>
        <translation>Auswahl</translation>
    </message>
    <message>
        <source>Compute</source>
        <translation>Berechnen</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
    <message>
        <source>The solid is gone: nothing was made</source>
        <translation>Den Festkörper gibt es nicht mehr: es wurde nichts erzeugt</translation>
    </message>
    <message>
        <source>Cancelled: the document is as it was</source>
        <translation>Abgebrochen: das Dokument ist wie zuvor</translation>
    </message>
    <message>
        <source>Not a valid solid: {0}. Check solid shows where.</source>
        <translation>Kein gültiger Festkörper: {0}. „Festkörper prüfen“ zeigt, wo.</translation>
    </message>
    <message>
        <source>Tetrahedralize</source>
        <translation>In Tetraeder zerlegen</translation>
    </message>
    <message>
        <source>Convex cells</source>
        <translation>Konvexe Zellen</translation>
    </message>
    <message>
        <source>{0} pieces, volume error {1:.0e}, {2:.2f} s</source>
        <translation>{0} Teile, Volumenfehler {1:.0e}, {2:.2f} s</translation>
    </message>
    <message>
        <source>Open edge</source>
        <translation>Offene Kante</translation>
    </message>
    <message>
        <source>Face turned inside out</source>
        <translation>Umgestülpte Fläche</translation>
    </message>
    <message>
        <source>Triangle without area</source>
        <translation>Dreieck ohne Fläche</translation>
    </message>
    <message>
        <source>Surface that lies twice</source>
        <translation>Doppelt liegende Fläche</translation>
    </message>
    <message>
        <source>Surface that crosses itself</source>
        <translation>Fläche, die sich selbst durchdringt</translation>
    </message>
    <message>
        <source>Coordinate that is no number</source>
        <translation>Koordinate, die keine Zahl ist</translation>
    </message>
    <message>
        <source>Solid without volume</source>
        <translation>Festkörper ohne Volumen</translation>
    </message>
    <message>
        <source>Nothing there</source>
        <translation>Nichts vorhanden</translation>
    </message>
    <message>
        <source>Shells nested wrongly</source>
        <translation>Falsch verschachtelte Hüllen</translation>
    </message>
    <message>
        <source>Contact that is not planar</source>
        <translation>Berührung, die nicht eben ist</translation>
    </message>
    <message>
        <source>Missing vertex</source>
        <translation>Fehlender Knoten</translation>
    </message>
    <message>
        <source>No solid</source>
        <translation>Kein Festkörper</translation>
    </message>
    <message>
        <source>Size out of range</source>
        <translation>Größe außerhalb des Bereichs</translation>
    </message>
    <message>
        <source>Explode</source>
        <translation>Auseinanderziehen</translation>
    </message>
    <message>
        <source>Factor</source>
        <translation>Faktor</translation>
    </message>
    <message>
        <source>Pieces</source>
        <translation>Teile</translation>
    </message>
    <message>
        <source>Notches</source>
        <translation>Kerben</translation>
    </message>
    <message>
        <source>State</source>
        <translation>Zustand</translation>
    </message>
    <message>
        <source>counting...</source>
        <translation>wird gezählt...</translation>
    </message>
    <message>
        <source>valid</source>
        <translation>gültig</translation>
    </message>
    <message>
        <source>{0} defects, see Check solid</source>
        <translation>{0} Fehler, siehe „Festkörper prüfen“</translation>
    </message>
    <message>
        <source>Faces</source>
        <translation>Flächen</translation>
    </message>
    <message>
        <source>Triangles</source>
        <translation>Dreiecke</translation>
    </message>
    <message>
        <source>Pieces at most</source>
        <translation>Teile höchstens</translation>
    </message>
    <message>
        <source>Expected pieces</source>
        <translation>Erwartete Teile</translation>
    </message>
    <message>
        <source>Expected time</source>
        <translation>Erwartete Dauer</translation>
    </message>
    <message>
        <source>under 1 s</source>
        <translation>unter 1 s</translation>
    </message>
    <message>
        <source>about {0} s</source>
        <translation>etwa {0} s</translation>
    </message>
    <message>
        <source>about {0} min</source>
        <translation>etwa {0} min</translation>
    </message>
    <message>
        <source>To FEM mesh</source>
        <translation>In FEM-Netz</translation>
    </message>
    <message>
        <source>{0} nodes, {1} tetrahedra, {2} triangles of the skin</source>
        <translation>{0} Knoten, {1} Tetraeder, {2} Dreiecke der Haut</translation>
    </message>
    <message>
        <source>Second order elements</source>
        <translation>Elemente zweiter Ordnung</translation>
    </message>
    <message>
        <source>Ten nodes for each tetrahedron; four are far too stiff in bending</source>
        <translation>Zehn Knoten je Tetraeder; vier sind bei Biegung viel zu steif</translation>
    </message>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Kopieren</translation>
    </message>
    <message>
        <source>Points</source>
        <translation>Punkte</translation>
    </message>
    <message>
        <source>Steiner points</source>
        <translation>Steiner-Punkte</translation>
    </message>
    <message>
        <source>Volume</source>
        <translation>Volumen</translation>
    </message>
    <message>
        <source>Volume error</source>
        <translation>Volumenfehler</translation>
    </message>
    <message>
        <source>Smallest angle</source>
        <translation>Kleinster Winkel</translation>
    </message>
    <message>
        <source>Largest angle</source>
        <translation>Größter Winkel</translation>
    </message>
    <message>
        <source>Mean ratio</source>
        <translation>Mittlere Güte</translation>
    </message>
    <message>
        <source>Verdict</source>
        <translation>Urteil</translation>
    </message>
    <message>
        <source>Smallest angles in degrees</source>
        <translation>Kleinste Winkel in Grad</translation>
    </message>
    <message>
        <source>Mean ratios, 1 is regular</source>
        <translation>Güte (mean ratio), 1 ist regelmäßig</translation>
    </message>
    <message>
        <source>verified</source>
        <translation>überprüft</translation>
    </message>
    <message>
        <source>Start</source>
        <translation>Beginn</translation>
    </message>
    <message>
        <source>Read</source>
        <translation>Lesen</translation>
    </message>
    <message>
        <source>Tessellate</source>
        <translation>Facettieren</translation>
    </message>
    <message>
        <source>Check</source>
        <translation>Prüfen</translation>
    </message>
    <message>
        <source>Count crossings</source>
        <translation>Kreuzungen zählen</translation>
    </message>
    <message>
        <source>Columns</source>
        <translation>Säulen</translation>
    </message>
    <message>
        <source>Fences</source>
        <translation>Zäune</translation>
    </message>
    <message>
        <source>Pull off cups</source>
        <translation>Kuppen abziehen</translation>
    </message>
    <message>
        <source>Skin</source>
        <translation>Haut</translation>
    </message>
    <message>
        <source>Cells</source>
        <translation>Zellen</translation>
    </message>
    <message>
        <source>Cut notches</source>
        <translation>Kerben schneiden</translation>
    </message>
    <message>
        <source>Merge cells</source>
        <translation>Zellen vereinigen</translation>
    </message>
    <message>
        <source>Remove points</source>
        <translation>Punkte entfernen</translation>
    </message>
    <message>
        <source>Restore coordinates</source>
        <translation>Koordinaten wiederherstellen</translation>
    </message>
    <message>
        <source>Verify</source>
        <translation>Überprüfen</translation>
    </message>
    <message>
        <source>Select an object made by Tetrahedralize or Convex cells</source>
        <translation>Ein Objekt auswählen, das „In Tetraeder zerlegen“ oder „Konvexe Zellen“ erzeugt hat</translation>
    </message>
    <message>
        <source>Select a solid, a body, a link or a compound of solids</source>
        <translation>Einen Festkörper, Body, Link oder Verbund von Festkörpern auswählen</translation>
    </message>
    <message>
        <source>Select one object only</source>
        <translation>Nur ein Objekt auswählen</translation>
    </message>
    <message>
        <source>A mesh is selected: make a solid of it with Part &gt; Create shape from mesh</source>
        <translation>Ein Netz ist ausgewählt: mit Part &gt; Form aus Netz erzeugen einen Festkörper daraus machen</translation>
    </message>
    <message>
        <source>The selected object has no shape</source>
        <translation>Das ausgewählte Objekt hat keine Form</translation>
    </message>
    <message>
        <source>The selected shape is a shell: make a solid of it first</source>
        <translation>Die ausgewählte Form ist eine Hülle: zuerst einen Festkörper daraus machen</translation>
    </message>
    <message>
        <source>The selected shape has no volume: select a solid</source>
        <translation>Die ausgewählte Form hat kein Volumen: einen Festkörper auswählen</translation>
    </message>
    <message>
        <source>Make solids of the pieces</source>
        <translation>Festkörper aus den Teilen machen</translation>
    </message>
</context>
<context>
    <name>TetraPreferences</name>
    <message>
        <source>General</source>
        <translation>Allgemein</translation>
    </message>
    <message>
        <source>Surface of round faces</source>
        <translation>Oberfläche runder Flächen</translation>
    </message>
    <message>
        <source>Chord height</source>
        <translation>Sehnenhöhe</translation>
    </message>
    <message>
        <source>How far chords may be from round faces; 0 is automatic: a thousandth of the diagonal</source>
        <translation>Wie weit Sehnen von runden Flächen abweichen dürfen; 0 ist automatisch: ein Tausendstel der Diagonale</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>Chord angle</source>
        <translation>Sehnenwinkel</translation>
    </message>
    <message>
        <source>The angle between neighbouring chords of round faces; 0 is automatic: 20 degrees</source>
        <translation>Der Winkel zwischen benachbarten Sehnen runder Flächen; 0 ist automatisch: 20 Grad</translation>
    </message>
    <message>
        <source>Pieces</source>
        <translation>Teile</translation>
    </message>
    <message>
        <source>Method of convex cells</source>
        <translation>Verfahren für konvexe Zellen</translation>
    </message>
    <message>
        <source>Cut notches (Bajaj, Dey)</source>
        <translation>Kerben schneiden (Bajaj, Dey)</translation>
    </message>
    <message>
        <source>Fences (Chazelle, Palios)</source>
        <translation>Zäune (Chazelle, Palios)</translation>
    </message>
    <message>
        <source>Direction of tetrahedra</source>
        <translation>Richtung der Tetraeder</translation>
    </message>
    <message>
        <source>X axis</source>
        <translation>X-Achse</translation>
    </message>
    <message>
        <source>Y axis</source>
        <translation>Y-Achse</translation>
    </message>
    <message>
        <source>Z axis</source>
        <translation>Z-Achse</translation>
    </message>
    <message>
        <source>Solids up to</source>
        <translation>Festkörper bis</translation>
    </message>
    <message>
        <source>An object with more pieces is drawn only; its solids are made on request</source>
        <translation>Ein Objekt mit mehr Teilen wird nur gezeichnet; seine Festkörper entstehen auf Wunsch</translation>
    </message>
    <message>
        <source> pieces</source>
        <translation> Teile</translation>
    </message>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
    <message>
        <source>The solid comes back when the pieces are deleted</source>
        <translation>Der Festkörper erscheint wieder, wenn die Teile gelöscht werden</translation>
    </message>
    <message>
        <source>Hide the solid when its pieces are there</source>
        <translation>Den Festkörper ausblenden, wenn seine Teile da sind</translation>
    </message>
    <message>
        <source>Off makes large results faster to turn</source>
        <translation>Ausgeschaltet lassen sich große Ergebnisse schneller drehen</translation>
    </message>
    <message>
        <source>Draw the edges of the pieces</source>
        <translation>Kanten der Teile zeichnen</translation>
    </message>
    <message>
        <source>FEM mesh</source>
        <translation>FEM-Netz</translation>
    </message>
    <message>
        <source>Ten nodes for each tetrahedron; four are far too stiff in bending</source>
        <translation>Zehn Knoten je Tetraeder; vier sind bei Biegung viel zu steif</translation>
    </message>
    <message>
        <source>Second order elements</source>
        <translation>Elemente zweiter Ordnung</translation>
    </message>
</context>
<context>
    <name>Tetra_CheckSolid</name>
    <message>
        <source>Check solid</source>
        <translation>Festkörper prüfen</translation>
    </message>
    <message>
        <source>Lists what is wrong with the selected solid and selects the faces at fault</source>
        <translation>Zählt auf, was am ausgewählten Festkörper fehlerhaft ist, und wählt die Flächen aus</translation>
    </message>
</context>
<context>
    <name>Tetra_ConvexCells</name>
    <message>
        <source>Convex cells</source>
        <translation>Konvexe Zellen</translation>
    </message>
    <message>
        <source>Cuts the selected solid into closed convex pieces that cover it exactly once</source>
        <translation>Zerschneidet den ausgewählten Festkörper in geschlossene konvexe Teile, die ihn genau einmal überdecken</translation>
    </message>
</context>
<context>
    <name>Tetra_Explode</name>
    <message>
        <source>Explode</source>
        <translation>Auseinanderziehen</translation>
    </message>
    <message>
        <source>Draws the pieces of the selected object apart by a factor</source>
        <translation>Zieht die Teile des ausgewählten Objekts um einen Faktor auseinander</translation>
    </message>
</context>
<context>
    <name>Tetra_Report</name>
    <message>
        <source>Report</source>
        <translation>Bericht</translation>
    </message>
    <message>
        <source>Shows counts, bounds, volumes and the quality of the selected object&apos;s pieces</source>
        <translation>Zeigt Anzahlen, Schranken, Volumen und Güte der Teile des ausgewählten Objekts</translation>
    </message>
</context>
<context>
    <name>Tetra_Tetrahedralize</name>
    <message>
        <source>Tetrahedralize</source>
        <translation>In Tetraeder zerlegen</translation>
    </message>
    <message>
        <source>Fills the selected solid with tetrahedra that meet face to face and keep its surface exactly</source>
        <translation>Füllt den ausgewählten Festkörper mit Tetraedern, die Fläche an Fläche liegen und seine Oberfläche genau erhalten</translation>
    </message>
</context>
<context>
    <name>Tetra_ToFemMesh</name>
    <message>
        <source>To FEM mesh</source>
        <translation>In FEM-Netz</translation>
    </message>
    <message>
        <source>Makes a FEM mesh of the selected solid or of its tetrahedra: nodes, volume elements and faces of the skin</source>
        <translation>Macht ein FEM-Netz aus dem ausgewählten Festkörper oder seinen Tetraedern: Knoten, Volumenelemente und Flächen der Haut</translation>
    </message>
</context>
<context>
    <name>Workbench</name>
    <message>
        <source>Exact convex cells and tetrahedra of solids</source>
        <translation>Exakte konvexe Zellen und Tetraeder von Festkörpern</translation>
    </message>
    <message>
        <source>Tetra</source>
        <translation>Tetra</translation>
    </message>
    <message>
        <source>&amp;Tetra</source>
        <translation>&amp;Tetra</translation>
    </message>
</context>
</TS>
