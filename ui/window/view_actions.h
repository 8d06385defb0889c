#pragma once

class QToolBar;

namespace chainmail {

class Actions;
class Colouring;
class Document;
class PanelArea;

/// Adds the submenu that turns, pans, zooms and fits. Its keys work in the view that has the keyboard focus, because
/// the same keys move the cursor in lists and fields.
void addCameraMoves(Actions& actions, PanelArea& area);

/// Adds the views along the axes, the choice of the axis that points up, and the projection. They act on all panels and
/// need an object in 3D.
void addSides(Actions& actions, const Document& document, PanelArea& area);

/// Adds the actions that add, remove, show, hide and swap panels, lay ghosts over them, and choose the panel that the
/// others are compared with.
void addPanelActions(Actions& actions, Document& document, PanelArea& area, Colouring& colouring);

/// Adds the choice of the panel to compare with to the tool bar. It is visible if there are more than two panels and
/// the colours compare panels.
void addCompared(QToolBar& bar, const Actions& actions, const PanelArea& area, Colouring& colouring);

}  // namespace chainmail
