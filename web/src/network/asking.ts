// One question at a time; while it is being answered the newest one waits, and those between are never asked.

export class Asking<Question> {
  private waiting: { question: Question } | null = null;
  private busy = true;

  /** Nothing is sent before `free` is called for the first time. */
  constructor(private readonly send: (question: Question) => void) {}

  ask(question: Question): void {
    if (this.busy) {
      this.waiting = { question };
      return;
    }
    this.busy = true;
    this.send(question);
  }

  /** The other side can take a question. */
  free(): void {
    this.busy = false;
    const next = this.waiting;
    this.waiting = null;
    if (next) this.ask(next.question);
  }

  /** Whether every question is answered, or gave way to a newer one that is. */
  get settled(): boolean {
    return !this.busy && !this.waiting;
  }
}
